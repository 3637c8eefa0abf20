#pragma once

#include <cstddef>
#include <cstdint>

#include "services/route/route.h"

namespace trailcast::route {

// Of a view that a catalog is asked by.
inline constexpr std::size_t kMaxViewFeatures = 840;

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
