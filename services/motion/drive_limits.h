#pragma once

#include "services/motion/motion.h"

namespace trailcast::motion {

// What a base is asked for at most, and what it can do.
struct DriveLimits {
  double speed_mps = 1.0;
  double turn_rate_radps = 1.0;
  double acceleration_mps2 = 1.0;
  // Of a car, which turns only while it drives (Ackermann steering); 0: the base turns on the spot.
  double turn_radius_m = 0.0;
};

// What a base that does `now` is to be told next, on the way to `wanted`, when it was last told
// `dt_s` ago. Speed and turning rate are reduced together, so that the path keeps its curvature,
// as far as a car's steering reaches. It may slow down at once and speeds up within the
// acceleration, also from standing: a turn on the spot by how its wheels go, 0.2 m from its middle.
[[nodiscard]] VelocityCommand Shape(const VelocityCommand& wanted, const VelocityCommand& now,
                                    double dt_s, const DriveLimits& limits);

}  // namespace trailcast::motion
