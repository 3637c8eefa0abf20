#include "agent/follow/terrain_check.h"

#include <fmt/format.h>

#include <cmath>

#include "services/base/angles.h"
#include "services/route/terrain_profile.h"

namespace trailcast::agent {

std::string TerrainCheck::Where(const route::Segment& segment) const {
  if (!segment.has_odometry) return fmt::format("in segment {}", segment.index.value());
  return fmt::format("in segment {}, {:.1f} to {:.1f} m along the route,", segment.index.value(),
                     length_m_, length_m_ + segment.length_m);
}

void TerrainCheck::Add(const route::Segment& segment) {
  const route::Terrain& terrain = segment.terrain;
  const double end_m = length_m_ + segment.length_m;
  if (limits_.slope_rad) {
    if (!terrain.slope_rad) ++slope_not_known_;
    if (terrain.slope_rad && std::abs(*terrain.slope_rad) > *limits_.slope_rad) {
      excesses_.push_back(
          {end_m, segment.has_odometry,
           fmt::format("{} it goes {}, and this robot's limit is {:.1f} degrees (--max-slope)",
                       Where(segment), route::SlopeText(*terrain.slope_rad),
                       Degrees(*limits_.slope_rad))});
    }
  }
  if (limits_.roughness) {
    const auto roughness = route::RoughnessOf(terrain);
    if (!roughness) ++roughness_not_known_;
    if (roughness && *roughness > *limits_.roughness) {
      excesses_.push_back(
          {end_m, segment.has_odometry,
           fmt::format("{} the ground is {}, and this robot's limit is {} (--max-roughness)",
                       Where(segment), route::RoughnessText(terrain),
                       route::NameOf(*limits_.roughness))});
    }
  }
  length_m_ = end_m;
  ++segments_;
}

std::optional<std::string> TerrainCheck::Refusal(double from_m) const {
  for (const Excess& excess : excesses_) {
    if (!excess.metric || excess.end_m > from_m) {
      return "this robot cannot drive this route: " + excess.what;
    }
  }
  return std::nullopt;
}

std::optional<std::string> TerrainCheck::NotKnown() const {
  std::string text;
  const auto add = [&](int count, const char* what) {
    if (count == 0) return;
    text +=
        fmt::format("{}{} of {} of {} segments", text.empty() ? "" : ", ", what, count, segments_);
  };
  add(slope_not_known_, "the slope");
  add(roughness_not_known_, "the roughness");
  if (text.empty()) return std::nullopt;
  return fmt::format(
      "whether this robot can drive all of this route is not known: {} was not felt "
      "when it was taught",
      text);
}

}  // namespace trailcast::agent
