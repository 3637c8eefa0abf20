#include "services/lab/sim/core/path_follow_driver.h"

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

constexpr double kSpacing_m = 0.02;
// Curvature is taken over this many points on either side (0.16 m).
constexpr std::size_t kCurvatureReach = 8;
// The robot may have come so far since the last command. The bound keeps it from jumping to another
// section of a path that crosses itself.
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

double TurnAt(const Polyline& points, std::size_t i) {
  const Eigen::Vector2d in = points[i] - points[i - 1];
  const Eigen::Vector2d out = points[i + 1] - points[i];
  return std::abs(WrapAngle(std::atan2(out.y(), out.x()) - std::atan2(in.y(), in.x())));
}

}  // namespace

PathFollowDriver::PathFollowDriver(const Polyline& way_points, const DriverOptions& options)
    : options_(options) {
  Polyline leg = {way_points.front()};
  for (std::size_t i = 1; i < way_points.size(); ++i) {
    leg.push_back(way_points[i]);
    const bool last = i + 1 == way_points.size();
    if (!last && TurnAt(way_points, i) <= options_.spot_turn_rad) continue;
    AddLeg(leg);
    leg = {way_points[i]};
  }
}

void PathFollowDriver::AddLeg(const Polyline& way_points) {
  Leg leg;
  leg.path = RoundCorners(way_points, options_.corner_radius_m, kSpacing_m);
  leg.length_m = Length(leg.path);
  PlanSpeeds(leg);
  path_.insert(path_.end(), leg.path.begin() + (path_.empty() ? 0 : 1), leg.path.end());
  legs_.push_back(std::move(leg));
}

// Plans speeds as high as turns allow, slowing down in time for them and for the end.
void PathFollowDriver::PlanSpeeds(Leg& leg) const {
  const Polyline& path = leg.path;
  std::vector<double>& speeds_mps = leg.speeds_mps;
  const double slowest_mps = options_.slowest_share * options_.speed_mps;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double turn_limit_mps =
        0.8 * options_.turning_radps / std::max(std::abs(Curvature(path, i)), 1e-6);
    speeds_mps.push_back(std::clamp(turn_limit_mps, slowest_mps, options_.speed_mps));
  }
  speeds_mps.back() = 0.0;
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    const double step_m = (path[i] - path[i - 1]).norm();
    const double reachable_mps =
        std::sqrt(speeds_mps[i] * speeds_mps[i] + 2.0 * options_.acceleration_mps2 * step_m);
    speeds_mps[i - 1] = std::min(speeds_mps[i - 1], reachable_mps);
  }
}

bool PathFollowDriver::backwards() const {
  if (!options_.shunts_from) return false;
  return (*options_.shunts_from == Gear::kBackwards) == (leg_ % 2 == 0);
}

// Returns true where the leg ends: the next one begins, or everything is driven.
bool PathFollowDriver::EndsLeg(const Eigen::Vector2d& place) {
  const Leg& leg = legs_[leg_];
  along_m_ = Nearest(leg.path, place, along_m_, along_m_ + kSearch_m).along_m;
  if (leg.length_m - along_m_ >= options_.arrived_within_m) return false;
  arrived_ = leg_ + 1 == legs_.size();
  if (arrived_) return true;
  ++leg_;
  along_m_ = 0.0;
  aligned_ = options_.shunts_from.has_value();
  return true;
}

double PathFollowDriver::progress() const {
  double driven_m = along_m_;
  double all_m = 0.0;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    all_m += legs_[i].length_m;
    if (i < leg_) driven_m += legs_[i].length_m;
  }
  return driven_m / all_m;
}

// Driving backwards is driving forwards with the robot's back in front.
motion::VelocityCommand PathFollowDriver::Command(const motion::Pose2& true_pose) {
  if (arrived_) return {};
  if (EndsLeg(motion::Position(true_pose))) return Command(true_pose);
  if (!backwards()) return Drive(true_pose);
  motion::Pose2 turned = true_pose;
  turned.heading_rad = WrapAngle(turned.heading_rad + Radians(180.0));
  const motion::VelocityCommand command = Drive(turned);
  return {-command.linear_mps, command.angular_radps};
}

// Drives along the leg, with the front that `pose` has.
motion::VelocityCommand PathFollowDriver::Drive(const motion::Pose2& pose) {
  const Leg& leg = legs_[leg_];
  const Polyline& path = leg.path;
  const Eigen::Vector2d place = motion::Position(pose);
  const double left_m = leg.length_m - along_m_;
  // Near the end the path has no point further ahead, so its last direction is the aim.
  const Eigen::Vector2d end_direction = (path.back() - path[path.size() - 2]).normalized();
  const double beyond_m = std::max(0.0, options_.look_ahead_m - left_m);
  const Eigen::Vector2d aim =
      PointAlong(path, along_m_ + options_.look_ahead_m) + beyond_m * end_direction;
  const Eigen::Vector2d to_aim = aim - place;
  const double bearing_rad = WrapAngle(std::atan2(to_aim.y(), to_aim.x()) - pose.heading_rad);
  if (std::abs(bearing_rad) < kFacing_rad) aligned_ = true;
  if (!aligned_ || std::abs(bearing_rad) > Radians(60.0)) {
    aligned_ = false;
    return {0.0, std::clamp(2.0 * bearing_rad, -options_.turning_radps, options_.turning_radps)};
  }
  const auto index = std::min(static_cast<std::size_t>(along_m_ / kSpacing_m), path.size() - 1);
  const double curvature = 2.0 * std::sin(bearing_rad) / to_aim.norm();
  double speed_mps = std::max(leg.speeds_mps[index], std::min(kCreep_mps, left_m * 3.0));
  if (std::abs(curvature) * speed_mps > options_.turning_radps) {
    speed_mps = options_.turning_radps / std::abs(curvature);
  }
  return {speed_mps, curvature * speed_mps};
}

}  // namespace trailcast::sim
