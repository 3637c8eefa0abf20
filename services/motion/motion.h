#pragma once

#include <Eigen/Core>

namespace trailcast::motion {

// A planar pose: x forward and y left in some local frame, heading counter-clockwise from x (REP
// 103). The variable's name tells the frame.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

// The motion that wheel odometry reports between two samples: metres driven (negative in reverse)
// and the change of heading, counter-clockwise positive.
struct OdometryIncrement {
  double distance_m = 0.0;
  double heading_change_rad = 0.0;
};

// A command for a robot's base; {0, 0} stops it.
struct VelocityCommand {
  double linear_mps = 0.0;
  double angular_radps = 0.0;  // counter-clockwise positive

  bool operator==(const VelocityCommand&) const = default;
};

struct VelocityLimits {
  double linear_mps = 1.0;
  double angular_radps = 1.0;
};

// Returns the pose `local` in the frame in which `origin` is given.
[[nodiscard]] Pose2 Compose(const Pose2& origin, const Pose2& local);
// Returns the pose `target` as seen from `origin`; both are in the same frame.
[[nodiscard]] Pose2 Between(const Pose2& origin, const Pose2& target);
// Returns the arc from one odometry pose to the next, signed by the direction of travel.
[[nodiscard]] OdometryIncrement IncrementBetween(const Pose2& before, const Pose2& after);
// Returns the pose after driving `increment` from `pose` along a circular arc.
[[nodiscard]] Pose2 Advance(const Pose2& pose, const OdometryIncrement& increment);
// Returns the pose at a share, 0..1, of the straight line from one to the other. The heading turns
// the shorter way.
[[nodiscard]] Pose2 Interpolate(const Pose2& from, const Pose2& to, double share);
// Cuts each component to its limit and keeps its sign.
[[nodiscard]] VelocityCommand Limit(const VelocityCommand& command, const VelocityLimits& limits);

[[nodiscard]] inline Eigen::Vector2d Position(const Pose2& pose) { return {pose.x_m, pose.y_m}; }

}  // namespace trailcast::motion
