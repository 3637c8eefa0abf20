#pragma once

#include "services/route/route.h"

namespace trailcast::route {

// A segment that was taught without odometry as if there had been some: the way and the turns are
// those that the pictures tell, driven at kUsualSpeed_mps. All of it is true but for one factor of
// its metres and one of its radians, which a follower has to find. Any other segment, and one that
// tells no such way, stays as it is.
[[nodiscard]] Segment AsDriven(Segment segment);

}  // namespace trailcast::route
