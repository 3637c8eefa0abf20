#pragma once

#include "services/motion/motion.h"

namespace trailcast::motion {

// The most that a base is asked for, and what it can do.
struct DriveLimits {
  double speed_mps = 1.0;
  double turn_rate_radps = 1.0;
  double acceleration_mps2 = 1.0;
  // The smallest radius of a car, which turns only while it drives (Ackermann steering). At 0 the
  // base can turn on the spot.
  double turn_radius_m = 0.0;
};

// Returns the next command for a base that does `now`, on the way to `wanted`, when its last
// command was `dt_s` ago. Speed and turn rate are reduced together, so that the path keeps its
// curvature as far as a car's steering allows. The base may slow down at once, but speeds up within
// the acceleration, also from standstill. A turn on the spot is measured by its wheels, 0.2 m from
// its middle.
[[nodiscard]] VelocityCommand Shape(const VelocityCommand& wanted, const VelocityCommand& now,
                                    double dt_s, const DriveLimits& limits);

}  // namespace trailcast::motion
