#include "agent/link/photo_sender.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "services/route/digest.h"

namespace trailcast::agent {
namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;

// Pieces grow while answers come sooner than the first, and shrink when they come later than the
// second.
constexpr milliseconds kQuick{100};
constexpr milliseconds kSlow{400};

}  // namespace

void PhotoSender::Begin() {
  offset_ = 0;
  pause_ = kSoon;
  again_at_ = {};
  photo_ = folder_.First();
  if (!photo_) return;
  jpeg_ = folder_.Read(photo_->id, 0, photo_->bytes).value_or(std::vector<std::uint8_t>());
  if (route::Sha256(jpeg_) == photo_->digest) return;
  news_.push_back(fmt::format("the photo of {} in mission {} is damaged on the disk, and removed",
                              photos::SpotText(*photo_), photo_->mission));
  folder_.Remove(photo_->id);
  photo_.reset();
}

void PhotoSender::Adapt(milliseconds answered_after) {
  if (answered_after < kQuick) piece_bytes_ = std::min(2 * piece_bytes_, kLargestPiece);
  if (answered_after > kSlow) piece_bytes_ = std::max(piece_bytes_ / 2, kSmallestPiece);
}

void PhotoSender::Handle(const exchange::Message& message, Time now) {
  const auto* answer = std::get_if<exchange::PhotoRequest>(&message);
  if (answer == nullptr || answer->holder != self_ || answer->client != server_) return;
  if (!photo_ || answer->photo != photo_->id) return;
  if (!answer->refusal.empty()) {
    if (answer->refusal != refused_) {
      news_.push_back(fmt::format("server '{}' does not take photos: {}; they stay here",
                                  answer->client.value(), answer->refusal));
    }
    refused_ = answer->refusal;
    again_at_ = now + kAfterRefusal;
    return;
  }
  if (answer->kept) {
    refused_.clear();
    folder_.Remove(photo_->id);
    return Begin();
  }
  // An answer to a piece that was sent twice says what is known already.
  if (answer->offset == offset_ && now < again_at_) return;
  Adapt(duration_cast<milliseconds>(now - sent_at_));
  offset_ = answer->offset;
  pause_ = kSoon;
  again_at_ = now;
}

std::vector<exchange::Message> PhotoSender::Due(Time now, const std::optional<AgentId>& server) {
  if (server != server_) {
    server_ = server;
    Begin();
  }
  if (!server_ || now < again_at_) return {};
  if (!photo_) Begin();
  if (!photo_) return {};
  const std::size_t begin = std::min<std::size_t>(offset_, jpeg_.size());
  const std::size_t end = std::min(begin + piece_bytes_, jpeg_.size());
  sent_at_ = now;
  again_at_ = now + pause_;
  pause_ = std::min(2 * pause_, kLate);
  return {exchange::PhotoPiece{.holder = self_,
                               .client = *server_,
                               .photo = photo_->id,
                               .words = ToText(*photo_),
                               .offset = offset_,
                               .bytes = {jpeg_.begin() + static_cast<std::ptrdiff_t>(begin),
                                         jpeg_.begin() + static_cast<std::ptrdiff_t>(end)}}};
}

}  // namespace trailcast::agent
