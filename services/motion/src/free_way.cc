#include "services/motion/free_way.h"

#include <algorithm>
#include <cmath>

namespace trailcast::motion {
namespace {

// Wider bends count as straight, and tighter ones as turns on the spot.
constexpr double kStraight_m = 1000.0;
constexpr double kOnTheSpot_m = 0.05;

std::optional<double> WayAhead(const Eigen::Vector2d& at, const Outline& outline) {
  if (at.x() < 0.0 || std::abs(at.y()) > outline.side_m) return std::nullopt;
  return std::max(0.0, at.x() - outline.front_m);
}

// Returns the distance along a turn about a point `radius_m` to the left until `at` is at the
// robot's front or side.
std::optional<double> WayLeft(const Eigen::Vector2d& at, const Outline& outline, double radius_m) {
  const double r = std::hypot(at.x(), radius_m - at.y());
  const double corner_m = std::hypot(outline.front_m, radius_m + outline.side_m);
  if (at.x() < 0.0 || r < radius_m - outline.side_m || r > corner_m) return std::nullopt;
  const double angle_rad = std::atan2(at.x(), radius_m - at.y()) -
                           std::asin(std::min(1.0, outline.front_m / std::max(r, 1e-6)));
  if (angle_rad < 0.0 && r > radius_m + outline.side_m) return std::nullopt;
  return std::max(0.0, angle_rad) * std::max(radius_m, outline.side_m);
}

std::optional<double> WayTo(const Eigen::Vector2d& at, const Outline& outline,
                            const VelocityCommand& command) {
  const double forward_mps = std::abs(command.linear_mps);
  const double turn_radps = std::abs(command.angular_radps);
  if (forward_mps < kOnTheSpot_m * turn_radps) {
    const double swept_m = std::hypot(std::max(outline.front_m, outline.side_m), outline.side_m);
    return at.norm() <= swept_m ? std::optional(0.0) : std::nullopt;
  }
  // In reverse the robot's back is ahead, and its turning point stays where it is.
  Eigen::Vector2d ahead = at;
  Outline body = outline;
  if (command.linear_mps < 0.0) {
    ahead.x() = -at.x();
    body.front_m = outline.side_m;
  }
  if (forward_mps > kStraight_m * turn_radps) return WayAhead(ahead, body);
  if (command.angular_radps * command.linear_mps < 0.0) ahead.y() = -ahead.y();
  return WayLeft(ahead, body, forward_mps / turn_radps);
}

}  // namespace

double Pace(const Outline& outline, const VelocityCommand& command) {
  return std::max(std::abs(command.linear_mps), outline.side_m * std::abs(command.angular_radps));
}

std::optional<InTheWay> FirstMet(const std::vector<Eigen::Vector2d>& points, const Outline& outline,
                                 const VelocityCommand& command) {
  std::optional<InTheWay> first;
  if (command == VelocityCommand{}) return first;
  for (const Eigen::Vector2d& at : points) {
    const auto way_m = WayTo(at, outline, command);
    if (way_m && (!first || *way_m < first->way_m)) first = InTheWay{*way_m, at};
  }
  return first;
}

}  // namespace trailcast::motion
