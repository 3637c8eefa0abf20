#include "services/lab/sim/core/robot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

// The wheels climb a step of this height; anything higher is a wall.
constexpr double kClimb_m = 0.15;
// A wheel over ground further below than this hangs at the body's height.
constexpr double kDrop_m = 0.5;
// Bumpers feel at these heights, all round in steps of 15 degrees.
constexpr std::array kBumperHeights_m = {0.12, 0.30};
constexpr int kBumperRays = 24;
// Less steep surfaces are driven over.
constexpr float kSteepNormalZ = 0.6F;

// A steering axle needs this time from the middle to its stop, and does not turn below this speed.
constexpr double kToFullLock_s = 0.4;
constexpr double kStands_mps = 0.01;

double Approach(double value, double target, double largest_change) {
  return value + std::clamp(target - value, -largest_change, largest_change);
}

}  // namespace

DifferentialDriveRobot::DifferentialDriveRobot(std::shared_ptr<const World> world,
                                               const RobotBody& body, const RobotErrors& errors,
                                               const motion::Pose2& start, double z_max_m,
                                               std::uint64_t seed)
    : world_(std::move(world)),
      body_(body),
      errors_(errors),
      slip_(seed, "slip"),
      pose_(start),
      z_m_(world_->GroundHeight(start.x_m, start.y_m, z_max_m).value_or(0.0)) {
  StandOnGround();
}

// Turns the axle towards the commanded curvature while the robot drives, and leaves it while the
// robot stands. Returns its curvature.
double DifferentialDriveRobot::Steer(const motion::VelocityCommand& command, double duration_s) {
  const double tightest_per_m = 1.0 / body_.turn_radius_m;
  if (std::abs(command.linear_mps) > kStands_mps) {
    const double wanted_per_m =
        std::clamp(command.angular_radps / command.linear_mps, -tightest_per_m, tightest_per_m);
    curvature_per_m_ =
        Approach(curvature_per_m_, wanted_per_m, tightest_per_m * duration_s / kToFullLock_s);
  }
  return curvature_per_m_;
}

DifferentialDriveRobot::Wheels DifferentialDriveRobot::Wanted(
    const motion::VelocityCommand& command, double duration_s) {
  const double half_base_m = body_.wheel_base_m / 2.0;
  double turning_mps = command.angular_radps * half_base_m;
  if (body_.turn_radius_m > 0.0) {
    turning_mps = Steer(command, duration_s) * command.linear_mps * half_base_m;
  }
  // Turning comes first: the speed ahead is reduced by what the wheels cannot do.
  const double room_mps = std::max(0.0, body_.top_speed_mps - std::abs(turning_mps));
  const double ahead_mps = std::clamp(command.linear_mps, -room_mps, room_mps);
  return {ahead_mps - turning_mps, ahead_mps + turning_mps};
}

void DifferentialDriveRobot::Drive(const motion::VelocityCommand& command, double duration_s,
                                   const Stage* actors) {
  const Wheels wanted = Wanted(command, duration_s);
  const double change_mps = body_.acceleration_mps2 * duration_s;
  left_mps_ = Approach(left_mps_, wanted.left, change_mps);
  right_mps_ = Approach(right_mps_, wanted.right, change_mps);
  const double left_m = left_mps_ * duration_s;
  const double right_m = right_mps_ * duration_s;
  odometry_ = motion::Advance(odometry_,
                              {(left_m + right_m) / 2.0, (right_m - left_m) / body_.wheel_base_m});

  const double true_left_m =
      left_m * grip_.left * errors_.odometry_scale * (1.0 + errors_.slip * slip_.Normal());
  const double true_right_m =
      right_m * grip_.right * errors_.odometry_scale * (1.0 + errors_.slip * slip_.Normal());
  motion::OdometryIncrement step{
      (true_left_m + true_right_m) / 2.0,
      (true_right_m - true_left_m) / (body_.wheel_base_m * errors_.wheel_base)};
  step.heading_change_rad += errors_.heading_bias_rad_per_m * step.distance_m;
  blocked_by_ = FeelAhead(step.distance_m, actors);
  if (blocked()) step.distance_m = 0.0;
  pose_ = motion::Advance(pose_, step);
  velocity_ = {step.distance_m / duration_s, step.heading_change_rad / duration_s};
  StandOnGround();
}

DifferentialDriveRobot::Obstacle DifferentialDriveRobot::FeelAhead(double step_m,
                                                                   const Stage* actors) const {
  if (std::abs(step_m) < 1e-9) return Obstacle::kNone;
  const double reach_m = body_.radius_m + std::abs(step_m);
  const double travel_rad = pose_.heading_rad + (step_m < 0.0 ? Radians(180.0) : 0.0);
  for (int i = 0; i < kBumperRays; ++i) {
    const double off_rad = 2.0 * Radians(180.0) * i / kBumperRays;
    if (std::cos(off_rad) < 0.1)
      continue;  // beside and behind it: the robot drives away from
                 // there
    const Eigen::Vector3f direction(static_cast<float>(std::cos(travel_rad + off_rad)),
                                    static_cast<float>(std::sin(travel_rad + off_rad)), 0.0F);
    for (const double height_m : kBumperHeights_m) {
      const Eigen::Vector3f from =
          Eigen::Vector3d(pose_.x_m, pose_.y_m, z_m_ + height_m).cast<float>();
      const auto hit = world_->CastRay(from, direction, reach_m);
      if (hit && std::abs(hit->normal.z()) < kSteepNormalZ) return Obstacle::kWorld;
      if (actors != nullptr && actors->CastRay(from, direction, reach_m)) return Obstacle::kActor;
    }
  }
  return Obstacle::kNone;
}

void DifferentialDriveRobot::StandOnGround() {
  const bool flat = world_->ground() == GroundMode::kFlat;
  if (flat && rough_.empty()) {
    z_m_ = roll_rad_ = pitch_rad_ = 0.0;
    return;
  }
  const auto height = [&](double ahead_m, double left_m) {
    const motion::Pose2 at = motion::Compose(pose_, {ahead_m, left_m, 0.0});
    const double bump_m = BumpAt(rough_, motion::Position(at));
    if (flat) return bump_m;
    const auto ground = world_->GroundHeight(at.x_m, at.y_m, z_m_ + kClimb_m);
    return ground && *ground > z_m_ - kDrop_m ? *ground + bump_m : z_m_;
  };
  const double a = body_.length_m / 2.0;
  const double b = body_.wheel_base_m / 2.0;
  const double front_left = height(a, b);
  const double front_right = height(a, -b);
  const double rear_left = height(-a, b);
  const double rear_right = height(-a, -b);
  z_m_ = (front_left + front_right + rear_left + rear_right) / 4.0;
  pitch_rad_ = std::atan2((rear_left + rear_right - front_left - front_right) / 2.0, 2.0 * a);
  roll_rad_ = std::atan2((front_left + rear_left - front_right - rear_right) / 2.0, 2.0 * b);
}

Eigen::Isometry3d DifferentialDriveRobot::WorldFromBody() const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(pose_.x_m, pose_.y_m, z_m_);
  pose.rotate(Eigen::AngleAxisd(pose_.heading_rad, Eigen::Vector3d::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(pitch_rad_, Eigen::Vector3d::UnitY()));
  pose.rotate(Eigen::AngleAxisd(roll_rad_, Eigen::Vector3d::UnitX()));
  return pose;
}

void DifferentialDriveRobot::SetRough(std::vector<RoughPatch> patches) {
  rough_ = std::move(patches);
  StandOnGround();
}

void DifferentialDriveRobot::PlaceAt(const motion::Pose2& pose) {
  pose_ = pose;
  StandOnGround();
}

}  // namespace trailcast::sim
