#pragma once

#include <cstddef>
#include <cstdint>

#include "services/route/route.h"

namespace trailcast::route {

// A view by which a catalog is asked has at most so many features.
inline constexpr std::size_t kMaxViewFeatures = 840;

// This is a segment of a route that looks like a view.
struct FoundPlace {
  RouteKey key;
  SegmentIndex segment;
  double score = 0.0;  // from 0 to 1; services/view defines it

  bool operator==(const FoundPlace&) const = default;
};

// This tells how much of what is stored was searched for a view.
struct ViewCoverage {
  std::uint64_t segments_indexed = 0;
  std::uint64_t segments_stored = 0;  // segments of the routes that were read so far
  std::uint64_t routes_unseen = 0;    // routes not read yet, whose segments are in neither number

  bool operator==(const ViewCoverage&) const = default;
};

}  // namespace trailcast::route
