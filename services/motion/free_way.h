#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/motion/motion.h"

namespace trailcast::motion {

// The outline of a robot from above: its distance from the axle to the front, and to either side.
// Behind the axle it reaches as far as to a side.
struct Outline {
  double front_m = 0.25;
  double side_m = 0.25;
};

// Returns the speed of the fastest part: the axle or, on a tight turn, the robot's side.
[[nodiscard]] double Pace(const Outline& outline, const VelocityCommand& command);

struct InTheWay {
  double way_m = 0.0;  // distance at that pace until the robot touches it
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
};

// Returns the first of `points` that a robot meets if it goes on with `command`, for half a turn at
// most, or nothing if it meets none or stands. A robot that turns on the spot meets at once
// everything within the circle that its front corners sweep.
[[nodiscard]] std::optional<InTheWay> FirstMet(const std::vector<Eigen::Vector2d>& points,
                                               const Outline& outline,
                                               const VelocityCommand& command);

}  // namespace trailcast::motion
