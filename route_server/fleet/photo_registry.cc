#include "route_server/fleet/photo_registry.h"

#include <fmt/format.h>

#include <algorithm>

#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/route/digest.h"

namespace trailcast::server {

std::optional<exchange::PhotoRequest> PhotoRegistry::Take(const exchange::PhotoPiece& piece) {
  if (piece.client != server_) return std::nullopt;
  exchange::PhotoRequest answer{.client = server_, .holder = piece.holder, .photo = piece.photo};
  const auto photo = photos::ParsePhoto(piece.words);
  const bool is_its_own = photo && photo->id == piece.photo && photo->robot == piece.holder;
  if (!is_its_own || photo->bytes > exchange::kMaxPhotoBytes) {
    answer.refusal = PlainText(!photo       ? photo.error().message
                               : is_its_own ? "it is too large"
                                            : "it is another robot's, or another photo",
                               exchange::kMaxLineBytes);
    return answer;
  }
  if (const auto known = folder_->Get(photo->id)) {
    answer.kept = known->digest == photo->digest;
    if (!answer.kept) answer.refusal = "another photo is called so";
    return answer;
  }
  if (writer_.IsWaiting(photo->id)) return std::nullopt;  // it hears when that is done
  UnderWay& under_way = under_way_.Touch(piece.holder);
  if (under_way.id != photo->id) under_way = {.id = photo->id};
  std::vector<std::uint8_t>& bytes = under_way.bytes;
  if (piece.offset == bytes.size() && bytes.size() + piece.bytes.size() <= photo->bytes) {
    bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
  }
  answer.offset = static_cast<std::uint32_t>(bytes.size());
  if (bytes.size() < photo->bytes) return answer;
  if (route::Sha256(bytes) != photo->digest) {  // from its beginning, once more
    bytes.clear();
    answer.offset = 0;
    return answer;
  }
  if (writer_.full()) {
    answer.refusal = fmt::format("{} photos wait for its disk, which is slow: it takes more later",
                                 PhotoWriter::kMostWaiting);
    return answer;
  }
  writer_.Put(*photo, std::move(bytes));
  under_way_.Erase(piece.holder);
  return std::nullopt;
}

std::vector<exchange::PhotoRequest> PhotoRegistry::TakeKept() {
  std::vector<exchange::PhotoRequest> told;
  for (const auto& [photo, gone] : writer_.TakeWritten()) {
    told.push_back({.client = server_, .holder = photo.robot, .photo = photo.id});
    if (!gone) {
      told.back().refusal = PlainText(gone.error().message, exchange::kMaxLineBytes);
      continue;
    }
    told.back().kept = true;
    notes_.push_back(fmt::format("photo {} of {} by {} in mission {}", photo.id,
                                 photos::SpotText(photo), photo.robot.value(), photo.mission));
    if (!gone->empty()) {
      notes_.push_back(fmt::format("{} photos went for it, the oldest: --photos-mb", gone->size()));
    }
  }
  return told;
}

std::optional<exchange::PhotoPiece> PhotoRegistry::Give(const exchange::PhotoRequest& request) {
  if (request.holder != server_) return std::nullopt;
  exchange::PhotoPiece piece{.holder = server_,
                             .client = request.client,
                             .photo = request.photo,
                             .offset = request.offset};
  auto bytes = folder_->Read(request.photo, request.offset, exchange::kMaxPhotoPieceBytes);
  const auto photo = folder_->Get(request.photo);
  if (bytes && photo) {
    piece.bytes = *std::move(bytes);
    piece.words = ToText(*photo);
  } else {
    piece.error = PlainText(bytes ? "there is no such photo any longer" : bytes.error().message,
                            exchange::kMaxLineBytes);
  }
  return piece;
}

exchange::NetworkReply PhotoRegistry::Answer(const exchange::NetworkRequest& request) const {
  exchange::NetworkReply reply{
      .server = server_, .client = request.client, .request = request.request};
  const auto query = photos::ParsePhotoQuery(request.words);
  if (!query) {
    reply.error = PlainText(query.error().message, exchange::kMaxLineBytes);
    return reply;
  }
  const auto found = folder_->Find(*query);
  const std::size_t begin = std::min<std::size_t>(request.first, found.size());
  const std::size_t end = std::min(begin + kMostAPage, found.size());
  for (std::size_t i = begin; i < end; ++i) reply.lines.push_back(ToText(found[i]));
  if (end < found.size()) reply.next = static_cast<std::uint32_t>(end);
  return reply;
}

}  // namespace trailcast::server
