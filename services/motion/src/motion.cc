#include "services/motion/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::motion {

Pose2 Compose(const Pose2& origin, const Pose2& local) {
  const Eigen::Vector2d p =
      Position(origin) + Eigen::Rotation2Dd(origin.heading_rad) * Position(local);
  return {p.x(), p.y(), WrapAngle(origin.heading_rad + local.heading_rad)};
}

Pose2 Between(const Pose2& origin, const Pose2& target) {
  const Eigen::Vector2d p =
      Eigen::Rotation2Dd(-origin.heading_rad) * (Position(target) - Position(origin));
  return {p.x(), p.y(), WrapAngle(target.heading_rad - origin.heading_rad)};
}

OdometryIncrement IncrementBetween(const Pose2& before, const Pose2& after) {
  const Pose2 step = Between(before, after);
  const double chord_m = std::hypot(step.x_m, step.y_m);
  const double half_rad = 0.5 * step.heading_rad;
  // This is the ratio of arc to chord: pi/2 for a half turn, and 1 for small turns.
  const double arc_over_chord = std::abs(half_rad) < 1e-9 ? 1.0 : half_rad / std::sin(half_rad);
  const Eigen::Vector2d chord_direction(std::cos(half_rad), std::sin(half_rad));
  const bool forward = chord_direction.dot(Eigen::Vector2d(step.x_m, step.y_m)) >= 0.0;
  return {(forward ? 1.0 : -1.0) * chord_m * arc_over_chord, step.heading_rad};
}

Pose2 Advance(const Pose2& pose, const OdometryIncrement& increment) {
  const double half_rad = 0.5 * increment.heading_change_rad;
  const double chord_over_arc = std::abs(half_rad) < 1e-9 ? 1.0 : std::sin(half_rad) / half_rad;
  const double chord_m = increment.distance_m * chord_over_arc;
  return Compose(pose, {chord_m * std::cos(half_rad), chord_m * std::sin(half_rad),
                        increment.heading_change_rad});
}

Pose2 Interpolate(const Pose2& from, const Pose2& to, double share) {
  const double turn_rad = WrapAngle(to.heading_rad - from.heading_rad);
  return {std::lerp(from.x_m, to.x_m, share), std::lerp(from.y_m, to.y_m, share),
          WrapAngle(from.heading_rad + share * turn_rad)};
}

VelocityCommand Limit(const VelocityCommand& command, const VelocityLimits& limits) {
  return {std::clamp(command.linear_mps, -limits.linear_mps, limits.linear_mps),
          std::clamp(command.angular_radps, -limits.angular_radps, limits.angular_radps)};
}

}  // namespace trailcast::motion
