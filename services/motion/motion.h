#pragma once

#include <Eigen/Core>

namespace trailcast::motion {

// Planar pose, x forward and y left of some local frame, heading counter-clockwise from x (the
// convention of REP 103). Which frame is in the variable's name.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

// What wheel odometry reports between two samples: metres driven (negative in reverse) and the
// heading's change, counter-clockwise positive.
struct OdometryIncrement {
  double distance_m = 0.0;
  double heading_change_rad = 0.0;
};

// Asked of a robot's base. {0, 0} is "stop".
struct VelocityCommand {
  double linear_mps = 0.0;
  double angular_radps = 0.0;  // counter-clockwise positive

  bool operator==(const VelocityCommand&) const = default;
};

struct VelocityLimits {
  double linear_mps = 1.0;
  double angular_radps = 1.0;
};

// Pose `local` seen in the frame in which `origin` is given.
[[nodiscard]] Pose2 Compose(const Pose2& origin, const Pose2& local);
// Pose `target` seen from `origin`; both in the same frame.
[[nodiscard]] Pose2 Between(const Pose2& origin, const Pose2& target);
// The arc from one odometry pose to the next, signed by the direction of travel.
[[nodiscard]] OdometryIncrement IncrementBetween(const Pose2& before, const Pose2& after);
// The pose after driving `increment` from `pose` along a circular arc.
[[nodiscard]] Pose2 Advance(const Pose2& pose, const OdometryIncrement& increment);
// The pose at a share, 0..1, of the straight way from one to the other, turning the shorter way.
[[nodiscard]] Pose2 Interpolate(const Pose2& from, const Pose2& to, double share);
// The command with each component cut to its limit, sign kept.
[[nodiscard]] VelocityCommand Limit(const VelocityCommand& command, const VelocityLimits& limits);

[[nodiscard]] inline Eigen::Vector2d Position(const Pose2& pose) { return {pose.x_m, pose.y_m}; }

}  // namespace trailcast::motion
