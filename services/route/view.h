#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/route/route.h"

namespace trailcast::route {

// What a camera sees at one moment, as far as a route's segments can be compared with it: features
// found and described as teaching does it, places in pixels of that camera from its image centre.
struct ViewFeature {
  Descriptor descriptor{};
  float u_px = 0.0F;
  float v_px = 0.0F;

  bool operator==(const ViewFeature&) const = default;
};
using View = std::vector<ViewFeature>;

inline constexpr std::size_t kMaxViewFeatures = 200;

// ORB describes nothing near a picture's edge: such a feature's descriptor is all zero.
[[nodiscard]] inline bool IsDescribed(const Descriptor& descriptor) {
  return descriptor != Descriptor{};
}

// A stretch of a route that looks like a view.
struct FoundPlace {
  RouteKey key;
  SegmentIndex segment;
  double score = 0.0;  // 0..1, services/view says of what

  bool operator==(const FoundPlace&) const = default;
};

// How much of what is stored was searched for a view.
struct ViewCoverage {
  std::uint64_t segments_indexed = 0;
  std::uint64_t segments_stored = 0;  // of the routes looked at so far
  std::uint64_t routes_unseen = 0;    // not looked at yet: their segments are in neither number

  bool operator==(const ViewCoverage&) const = default;
};

}  // namespace trailcast::route
