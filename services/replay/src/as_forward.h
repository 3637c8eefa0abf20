#pragma once

#include "services/route/route.h"

namespace trailcast::replay {

// Returns a segment that was driven backwards as if it had been driven forwards, from its end to
// its beginning, and any other segment as it is. The camera looks in the same direction all along,
// so features that come nearer, and what they tell of the place beside the path, are then as in any
// segment. A robot that drives it backwards begins at its length and ends at 0. It has no key
// views.
[[nodiscard]] route::Segment AsForward(const route::Segment& segment);

// Returns where a robot enters such a segment, and where it leaves it, in metres along.
[[nodiscard]] inline double EntryOf(const route::Segment& segment) {
  return segment.reverse ? segment.length_m : 0.0;
}
[[nodiscard]] inline double ExitOf(const route::Segment& segment) {
  return segment.reverse ? 0.0 : segment.length_m;
}

}  // namespace trailcast::replay
