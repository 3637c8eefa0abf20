#pragma once

#include <vector>

#include "services/base/ids.h"
#include "services/route/route.h"
#include "services/vision/feature_tracker.h"

namespace trailcast::agent {

// This is how a segment's stored features were sought.
enum class SearchKind {
  kHandOver,     // at the segment's start
  kLookedAgain,  // nearby, because many were lost
  kRecovered,    // over the whole picture and in the segments ahead, after all were lost
};

// This is a search that changed which features are followed.
struct Search {
  SearchKind kind = SearchKind::kHandOver;
  SegmentIndex segment;
  int stored = 0;  // features that the segment has
  int found = 0;
  bool wide = false;      // over the whole picture, not only where they were expected
  double length_m = 0.0;  // length of the segment, as it was taught
  double speed_mps = 0.0;
};

[[nodiscard]] inline Search SearchOf(SearchKind kind, const route::Segment& segment, int found,
                                     bool wide) {
  return {kind,
          segment.index,
          static_cast<int>(segment.features.size()),
          found,
          wide,
          segment.length_m,
          segment.speed_mps()};
}

// This is the outcome of the segment's features in one frame.
struct Sight {
  int stored = 0;  // features that the segment has
  vision::TrackLosses lost;
  std::vector<Search> searches;
};

}  // namespace trailcast::agent
