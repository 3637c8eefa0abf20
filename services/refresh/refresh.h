#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/base/result.h"
#include "services/refresh/visit.h"
#include "services/route/route.h"

namespace trailcast::refresh {

struct RefreshOptions {
  // A route becomes no larger than that by what is added; one that is larger keeps its size.
  double most_bytes_per_m = 4900.0;
  int missed_to_drop = 3;       // visits in a row
  double most_share = 0.25;     // of a segment's features dropped, and added, by one visit
  std::size_t fewest_left = 8;  // features of a segment, whatever was missed
  int most_added_views = 1;     // beside each of the scout's, which is never dropped
  // What a visit says of features, or of key views, is not believed if it found a smaller share of
  // all that it could judge, or judged fewer of them than that: it was elsewhere, or saw badly.
  double least_found_share = 0.3;
  double least_judged_share = 0.2;
};

// Of features, or of key views.
struct RefreshCounts {
  int found = 0;
  int missed = 0;
  int unjudged = 0;
  int dropped = 0;
  int added = 0;

  // Of those judged.
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

// The route as the visit leaves it: features, and key views that followers had added, which were
// missed for long are gone, some of those offered are there. All else (length, heading, turns, the
// scout's key views, the features that remain, their order) is as it was, so that however often a
// route is refreshed, its path is the scout's.
// kUnavailable for a visit that is not to be believed; kInvalidArgument for one of another route.
[[nodiscard]] Result<Refreshed> Refresh(const std::vector<route::Segment>& route,
                                        const Visit& visit, const RefreshOptions& options = {});

}  // namespace trailcast::refresh
