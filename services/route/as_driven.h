#pragma once

#include "services/route/route.h"

namespace trailcast::route {

// Returns a segment that was taught without odometry as if it had some: the path and the turns that
// its pictures tell, driven at kUsualSpeed_mps. They are true up to one factor of its metres and
// one of its radians, which a follower has to find. A segment with odometry, or without such a
// path, is returned unchanged.
[[nodiscard]] Segment AsDriven(Segment segment);

}  // namespace trailcast::route
