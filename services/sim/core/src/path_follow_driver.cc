#include "services/sim/core/path_follow_driver.h"

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

constexpr double kSpacing_m = 0.02;
// Curvature is taken over this many points on either side (0.16 m).
constexpr std::size_t kCurvatureReach = 8;
// How far the robot may have come since the last command: it cannot jump to another stretch of a
// path that crosses itself.
constexpr double kSearch_m = 1.0;
constexpr double kFacing_rad = Radians(8.0);
constexpr double kCreep_mps = 0.05;

double Curvature(const Polyline& path, std::size_t i) {
  const std::size_t before = i < kCurvatureReach ? 0 : i - kCurvatureReach;
  const std::size_t after = std::min(i + kCurvatureReach, path.size() - 1);
  if (before == i || after == i) return 0.0;
  const Eigen::Vector2d in = path[i] - path[before];
  const Eigen::Vector2d out = path[after] - path[i];
  const double turn_rad = WrapAngle(std::atan2(out.y(), out.x()) - std::atan2(in.y(), in.x()));
  return 2.0 * turn_rad / (in.norm() + out.norm());
}

}  // namespace

PathFollowDriver::PathFollowDriver(const Polyline& way_points, const DriverOptions& options)
    : options_(options),
      path_(RoundCorners(way_points, options.corner_radius_m, kSpacing_m)),
      length_m_(Length(path_)) {
  PlanSpeeds();
}

// As fast as turns allow, slowing down for them in time and for the end.
void PathFollowDriver::PlanSpeeds() {
  const double slowest_mps = options_.slowest_share * options_.speed_mps;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const double turn_limit_mps =
        0.8 * options_.turning_radps / std::max(std::abs(Curvature(path_, i)), 1e-6);
    speeds_mps_.push_back(std::clamp(turn_limit_mps, slowest_mps, options_.speed_mps));
  }
  speeds_mps_.back() = 0.0;
  for (std::size_t i = path_.size() - 1; i > 0; --i) {
    const double step_m = (path_[i] - path_[i - 1]).norm();
    const double reachable_mps =
        std::sqrt(speeds_mps_[i] * speeds_mps_[i] + 2.0 * options_.acceleration_mps2 * step_m);
    speeds_mps_[i - 1] = std::min(speeds_mps_[i - 1], reachable_mps);
  }
}

motion::VelocityCommand PathFollowDriver::Command(const motion::Pose2& true_pose) {
  if (arrived_) return {};
  const Eigen::Vector2d place = motion::Position(true_pose);
  along_m_ = Nearest(path_, place, along_m_, along_m_ + kSearch_m).along_m;
  const double left_m = length_m_ - along_m_;
  if (left_m < options_.arrived_within_m) {
    arrived_ = true;
    return {};
  }
  // Near the end there is nothing further ahead on the path: aim along its last direction.
  const Eigen::Vector2d end_direction = (path_.back() - path_[path_.size() - 2]).normalized();
  const double beyond_m = std::max(0.0, options_.look_ahead_m - left_m);
  const Eigen::Vector2d aim =
      PointAlong(path_, along_m_ + options_.look_ahead_m) + beyond_m * end_direction;
  const Eigen::Vector2d to_aim = aim - place;
  const double bearing_rad = WrapAngle(std::atan2(to_aim.y(), to_aim.x()) - true_pose.heading_rad);
  if (std::abs(bearing_rad) < kFacing_rad) aligned_ = true;
  if (!aligned_ || std::abs(bearing_rad) > Radians(60.0)) {
    aligned_ = false;
    return {0.0, std::clamp(2.0 * bearing_rad, -options_.turning_radps, options_.turning_radps)};
  }
  const auto index = std::min(static_cast<std::size_t>(along_m_ / kSpacing_m), path_.size() - 1);
  const double curvature = 2.0 * std::sin(bearing_rad) / to_aim.norm();
  double speed_mps = std::max(speeds_mps_[index], std::min(kCreep_mps, left_m * 3.0));
  if (std::abs(curvature) * speed_mps > options_.turning_radps) {
    speed_mps = options_.turning_radps / std::abs(curvature);
  }
  return {speed_mps, curvature * speed_mps};
}

}  // namespace trailcast::sim
