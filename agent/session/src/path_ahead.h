#pragma once

#include "agent/session/src/known_route.h"
#include "services/replay/passing.h"

namespace trailcast::agent {

// Where the route goes from `along_m` of a segment on, for `length_m`, or as far as it is known and
// driven without a stop.
[[nodiscard]] replay::PathAhead PathAheadOf(const KnownRoute& route, SegmentIndex index,
                                            double along_m, double length_m);

}  // namespace trailcast::agent
