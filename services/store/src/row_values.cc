#include "services/store/src/row_values.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

#include "services/route/codec.h"
#include "services/route/digest.h"

namespace trailcast::store {
namespace {

constexpr std::size_t kMaxCameraBytes = 128;
constexpr int kMaxImagePx = 65536;

route::Digest Sha256(const std::string& text) {
  return route::Sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

tl::unexpected<Error> Refuse(const route::RouteInfo& info, std::string_view field,
                             const std::string& expected) {
  return Fail(ErrorCode::kInvalidArgument, "{} cannot be stored: its {} {}", Describe(info.key),
              field, expected);
}

std::string SealedBefore5(const route::RouteInfo& info) {
  std::string text = fmt::format(
      "{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{:a}\n{}\n{}\n", info.key.route.value(),
      info.key.teaching.value(), info.name, info.scout.value(), info.camera, info.image_width_px,
      info.image_height_px, info.taught_unix_ms, static_cast<int>(info.state), info.segment_count,
      info.length_m, info.bytes, route::ToHex(info.manifest_digest));
  for (const std::string& tag : info.tags) text += fmt::format("tag {}\n", tag);
  if (info.place) {
    text += fmt::format("place {} {:a} {:a}\n", static_cast<int>(info.place->frame), info.place->x,
                        info.place->y);
  }
  return text;
}

}  // namespace

route::Digest SealBefore5(const route::RouteInfo& info) { return Sha256(SealedBefore5(info)); }

route::Digest Seal(const route::RouteInfo& info) {
  return Sha256(SealedBefore5(info) + fmt::format("labels {} {} {} {}\n{}\n", info.revision.value(),
                                                  info.cut_off, static_cast<int>(info.standing),
                                                  info.edition, info.description));
}

route::Digest Seal(const route::SegmentPiece& piece) {
  return Sha256(fmt::format("{}\n{}\n{}\n{}\n", piece.key.route.value(), piece.key.teaching.value(),
                            piece.index.value(), route::ToHex(piece.digest)));
}

// As text they are one column; route_tag, by which routes are found, is made from it.
std::string JoinTags(const std::vector<std::string>& tags) {
  return fmt::format("{}", fmt::join(tags, " "));
}

std::vector<std::string> SplitTags(const std::string& joined) {
  std::vector<std::string> tags;
  std::istringstream words(joined);
  for (std::string tag; words >> tag;) tags.push_back(tag);
  return tags;
}

std::string Describe(const route::RouteKey& key, SegmentIndex index) {
  return fmt::format("segment {} of {}", index.value(), Describe(key));
}

tl::unexpected<Error> DamagedRoute(const route::RouteInfo& info) {
  return Fail(ErrorCode::kCorrupt,
              "what is known of {} (named '{}') is damaged; it mends when a holder announces it",
              Describe(info.key), info.name);
}

tl::unexpected<Error> DamagedSegment(const route::RouteKey& key, SegmentIndex index) {
  return Fail(ErrorCode::kCorrupt,
              "{}: its row is damaged; it mends when the segment is stored again",
              Describe(key, index));
}

Result<void> CheckRoute(const route::RouteInfo& info) {
  const std::string name_rule = "must be 1 to 64 of [A-Za-z0-9_.-]";
  if (!IsValidName(info.key.route.value())) return Refuse(info, "id", name_rule);
  if (!IsValidName(info.name)) return Refuse(info, "name", name_rule);
  if (!IsValidName(info.scout.value())) return Refuse(info, "scout", name_rule);
  if (info.camera.size() > kMaxCameraBytes) {
    return Refuse(info, "camera", fmt::format("must have at most {} bytes", kMaxCameraBytes));
  }
  const auto [smallest, largest] = std::minmax(info.image_width_px, info.image_height_px);
  if (smallest < 0 || largest > kMaxImagePx) {
    return Refuse(info, "image size", fmt::format("must lie in 0..{}", kMaxImagePx));
  }
  if (!std::isfinite(info.length_m)) return Refuse(info, "length", "must be finite");
  if (info.bytes > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    return Refuse(info, "number of bytes", "must be below 2^63");
  }
  if (info.tags.size() > route::kMaxTags ||
      !std::all_of(info.tags.begin(), info.tags.end(), &IsValidName) ||
      std::adjacent_find(info.tags.begin(), info.tags.end(), std::greater_equal<>()) !=
          info.tags.end()) {
    return Refuse(info, "tags",
                  fmt::format("must be at most {} names of [A-Za-z0-9_.-], sorted, none twice",
                              route::kMaxTags));
  }
  if (info.place && (!std::isfinite(info.place->x) || !std::isfinite(info.place->y))) {
    return Refuse(info, "place", "must be finite");
  }
  if (info.description.size() > route::kMaxDescriptionBytes) {
    return Refuse(info, "description",
                  fmt::format("must have at most {} bytes", route::kMaxDescriptionBytes));
  }
  if (info.standing > route::Standing::kDeleted) {
    return Refuse(info, "standing", "must be staged, active, retired or deleted");
  }
  if (info.state != route::RouteState::kTeaching && info.state != route::RouteState::kComplete) {
    return Refuse(info, "state", "must be teaching or complete");
  }
  return {};
}

Result<void> CheckSegment(const route::SegmentPiece& piece) {
  if (!IsValidName(piece.key.route.value())) {
    return Fail(ErrorCode::kInvalidArgument,
                "a segment cannot be stored: its route's id must be 1 to 64 of [A-Za-z0-9_.-]");
  }
  if (piece.bytes.empty() || piece.bytes.size() > route::kMaxSegmentBytes) {
    return Fail(ErrorCode::kCorrupt, "{} has {} bytes, expected 1 to {}",
                Describe(piece.key, piece.index), piece.bytes.size(), route::kMaxSegmentBytes);
  }
  return route::CheckDigest(piece);
}

}  // namespace trailcast::store
