#pragma once

#include "services/route/route.h"

namespace trailcast::replay {

// A segment that was driven backwards as if it had been driven forwards, from its end to its
// beginning; any other as it is. Its camera looks the same way all along, so that what features do
// when it comes nearer, and what they say of the place beside the path, is then as in any segment:
// a robot that drives it backwards begins at its length and ends at 0. Without key views.
[[nodiscard]] route::Segment AsForward(const route::Segment& segment);

// Where a robot comes to such a segment, and where it leaves it; metres along.
[[nodiscard]] inline double EntryOf(const route::Segment& segment) {
  return segment.reverse ? segment.length_m : 0.0;
}
[[nodiscard]] inline double ExitOf(const route::Segment& segment) {
  return segment.reverse ? 0.0 : segment.length_m;
}

}  // namespace trailcast::replay
