#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/motion/motion.h"

namespace trailcast::motion {

// A robot from above: from its axle so far to the front, and to either side. Behind the axle it is
// taken to reach as far as to a side.
struct Outline {
  double front_m = 0.25;
  double side_m = 0.25;
};

// How fast some part of it goes: the axle, or on a tighter turn its side.
[[nodiscard]] double Pace(const Outline& outline, const VelocityCommand& command);

struct InTheWay {
  double way_m = 0.0;  // at that pace, until the robot touches it
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
};

// The first of `points` that a robot meets which goes on as `command` says, for half a turn at
// most; nothing: none, or it stands. Turning on the spot it meets at once whatever is within the
// circle that its front corners sweep.
[[nodiscard]] std::optional<InTheWay> FirstMet(const std::vector<Eigen::Vector2d>& points,
                                               const Outline& outline,
                                               const VelocityCommand& command);

}  // namespace trailcast::motion
