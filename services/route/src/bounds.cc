#include "services/route/bounds.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "services/base/text.h"

namespace trailcast::route {
namespace {

Result<void> CheckOrdered(const std::vector<std::string>& tags) {
  if (std::adjacent_find(tags.begin(), tags.end(), std::greater_equal<>()) == tags.end()) return {};
  return Fail(ErrorCode::kInvalidArgument, "tags are not sorted, or one is there twice");
}

}  // namespace

Result<void> CheckName(const char* field, const std::string& name) {
  if (IsValidName(name)) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "{} \"{}\" is not a name: 1 to 64 of letters, digits, '_', '.', '-'", field,
              PlainText(name, 80));
}

Result<void> CheckText(const char* field, const std::string& text, std::size_t max_bytes) {
  if (IsPlainText(text, max_bytes)) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "{} is not one line of UTF-8 of at most {} bytes without control characters", field,
              max_bytes);
}

Result<void> CheckCount(const char* field, std::uint64_t count, std::uint64_t max) {
  if (count <= max) return {};
  return Fail(ErrorCode::kInvalidArgument, "{} is {}, at most {} is accepted", field, count, max);
}

Result<void> CheckAmount(const char* field, double value, double max) {
  if (value >= 0.0 && value <= max) return {};  // false for NaN
  return Fail(ErrorCode::kInvalidArgument, "{} is {}, expected 0 to {}", field, value, max);
}

Result<void> CheckState(RouteState state) {
  return CheckEnum("route state", state, RouteState::kComplete);
}

Result<void> CheckStanding(Standing standing) {
  return CheckEnum("standing", standing, Standing::kDeleted);
}

Result<void> CheckKey(const RouteKey& key) {
  const std::string& id = key.route.value();
  const bool hex = std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
  });
  if (id.size() != 32 || !hex) {
    return Fail(ErrorCode::kInvalidArgument,
                "route id \"{}\" is not 32 lower-case hexadecimal digits", PlainText(id, 80));
  }
  if (key.teaching.value() == 0 || key.teaching.value() > kMaxTeaching) {
    return Fail(ErrorCode::kInvalidArgument, "a teaching of route {} is named {}, expected 1 to {}",
                id, key.teaching.value(), kMaxTeaching);
  }
  return {};
}

Result<void> CheckTags(const std::vector<std::string>& tags) {
  if (auto ok = CheckCount("tags", tags.size(), kMaxTags); !ok) return ok;
  for (const std::string& tag : tags) {
    if (auto ok = CheckName("tag", tag); !ok) return ok;
  }
  return {};
}

Result<void> CheckPlace(const Place& place) {
  constexpr double kMaxSite_m = 1e7;
  const bool globe = place.frame == Place::Frame::kWgs84;
  if (!globe && place.frame != Place::Frame::kSite) {
    return Fail(ErrorCode::kInvalidArgument, "place frame is {}, expected 1 (site) or 2 (WGS 84)",
                static_cast<int>(place.frame));
  }
  if (auto ok = CheckAmount(globe ? "longitude, east or west, in degrees" : "site x in metres",
                            std::abs(place.x), globe ? 180.0 : kMaxSite_m);
      !ok) {
    return ok;
  }
  return CheckAmount(globe ? "latitude, north or south, in degrees" : "site y in metres",
                     std::abs(place.y), globe ? 90.0 : kMaxSite_m);
}

Result<void> CheckInfo(const RouteInfo& info) {
  if (auto ok = CheckKey(info.key); !ok) return ok;
  if (auto ok = CheckName("route name", info.name); !ok) return ok;
  if (auto ok = CheckName("scout", info.scout.value()); !ok) return ok;
  if (auto ok = CheckText("camera", info.camera, kMaxCameraBytes); !ok) return ok;
  if (auto ok = CheckAmount("image width", info.image_width_px, kMaxImageSide_px); !ok) return ok;
  if (auto ok = CheckAmount("image height", info.image_height_px, kMaxImageSide_px); !ok) {
    return ok;
  }
  if (auto ok = CheckState(info.state); !ok) return ok;
  if (auto ok = CheckCount("segment count", info.segment_count, kMaxSegmentsPerRoute); !ok) {
    return ok;
  }
  if (auto ok = CheckStanding(info.standing); !ok) return ok;
  if (auto ok = CheckText("description", info.description, kMaxDescriptionBytes); !ok) return ok;
  if (auto ok = CheckCount("bytes in a route", info.bytes, kMaxRouteBytes); !ok) return ok;
  if (auto ok = CheckTags(info.tags); !ok) return ok;
  if (auto ok = CheckOrdered(info.tags); !ok) return ok;
  if (info.place) {
    if (auto ok = CheckPlace(*info.place); !ok) return ok;
  }
  return CheckAmount("route length in metres", info.length_m, kMaxLength_m);
}

}  // namespace trailcast::route
