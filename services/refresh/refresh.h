#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/base/result.h"
#include "services/refresh/visit.h"
#include "services/route/route.h"

namespace trailcast::refresh {

struct RefreshOptions {
  // Additions do not make a route larger than this; a route that is larger keeps its size.
  double most_bytes_per_m = 2500.0;
  int missed_to_drop = 3;       // consecutive visits
  double most_share = 0.25;     // share of a segment's features that one visit may drop, and add
  std::size_t fewest_left = 8;  // a segment keeps so many features, whatever was missed
  int most_added_views = 1;     // beside each of the scout's, which are never dropped
  // A visit's findings on features, or on key views, are not believed if it found a smaller share
  // of those that it judged, or judged a smaller share of all. Such a robot was somewhere else, or
  // saw badly.
  double least_found_share = 0.3;
  double least_judged_share = 0.2;
};

// Counts of features, or of key views.
struct RefreshCounts {
  int found = 0;
  int missed = 0;
  int unjudged = 0;
  int dropped = 0;
  int added = 0;

  // The share found of those judged.
  [[nodiscard]] double found_share() const {
    return found + missed > 0 ? static_cast<double>(found) / (found + missed) : 0.0;
  }
  bool operator==(const RefreshCounts&) const = default;
};

struct Refreshed {
  std::vector<route::Segment> segments;
  RefreshCounts counts;  // of features
  RefreshCounts views;
};

// Returns the route as the visit leaves it. Features, and key views that followers had added, are
// dropped if they were missed for long, and some of the offered ones are added. Everything else
// (length, heading, turns, the scout's key views, the remaining features and their order) stays, so
// that a route's path remains the scout's however often it is refreshed. kUnavailable is a visit
// that is not believed; kInvalidArgument is one of another route.
[[nodiscard]] Result<Refreshed> Refresh(const std::vector<route::Segment>& route,
                                        const Visit& visit, const RefreshOptions& options = {});

}  // namespace trailcast::refresh
