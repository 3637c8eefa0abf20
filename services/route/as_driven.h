#pragma once

#include "services/route/route.h"

namespace trailcast::route {

// A segment that was taught without odometry as if there had been some: driven at kUsualSpeed_mps,
// turned as far as the picture did. All of it is true but for one factor of its metres and one of
// its radians, which whoever follows it has to find. Any other segment, and one that does not tell
// how the picture turned, stays as it is.
[[nodiscard]] Segment AsDriven(Segment segment);

}  // namespace trailcast::route
