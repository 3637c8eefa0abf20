#include "services/lab/sim/core/simulated_robot.h"

#include <cmath>
#include <numbers>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

Eigen::Isometry3d Mount(const CameraModel& camera, const RobotErrors& errors) {
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translation() =
      Eigen::Vector3d(camera.ahead_m, 0.0, camera.height_m + errors.camera_height_m);
  mount.linear() =
      BodyFromCamera(Radians(camera.yaw_deg) + errors.camera_yaw_rad,
                     Radians(camera.pitch_deg) + errors.camera_pitch_rad, Radians(camera.roll_deg));
  return mount;
}

motion::Pose2 TrueStart(const SimulatedRobotOptions& options, const RobotErrors& errors) {
  return motion::Compose(options.start,
                         {errors.start_ahead_m, errors.start_left_m, errors.start_heading_rad});
}

SensorOptions WithGain(SensorOptions sensor, double gain) {
  sensor.gain *= gain;
  return sensor;
}

}  // namespace

Result<std::unique_ptr<SimulatedRobot>> SimulatedRobot::Create(
    const std::shared_ptr<const World>& world, const SimulatedRobotOptions& options) {
  if (auto valid = Validate(options.camera); !valid) return tl::unexpected(valid.error());
  if (!(options.rate_hz >= 1.0 && options.rate_hz <= 1000.0)) {
    return Fail(ErrorCode::kInvalidArgument, "rate {} Hz is not possible: expected 1 to 1000",
                options.rate_hz);
  }
  const RobotErrors errors =
      DrawRobot(options.disturbances, options.robot_seed.value_or(options.seed), options.seed);
  const motion::Pose2 start = TrueStart(options, errors);
  const auto ground = options.start_z_max_m
                          ? world->GroundHeight(start.x_m, start.y_m, *options.start_z_max_m)
                          : world->FloorHeight(start.x_m, start.y_m);
  if (!ground) {
    const auto& bounds = world->bounds();
    return Fail(ErrorCode::kInvalidArgument,
                "no ground to stand on at ({:.2f}, {:.2f}) in {}: the world reaches from ({:.2f}, "
                "{:.2f}, {:.2f}) to ({:.2f}, {:.2f}, {:.2f}); check up axis, scale and path",
                start.x_m, start.y_m, world->name(), bounds.min().x(), bounds.min().y(),
                bounds.min().z(), bounds.max().x(), bounds.max().y(), bounds.max().z());
  }
  return std::unique_ptr<SimulatedRobot>(
      new SimulatedRobot(world, options, errors, *ground + 1e-3));
}

SimulatedRobot::SimulatedRobot(const std::shared_ptr<const World>& world,
                               const SimulatedRobotOptions& options, const RobotErrors& errors,
                               double z_max_m)
    : camera_(options.camera),
      period_s_(1.0 / options.rate_hz),
      body_from_camera_(Mount(options.camera, errors)),
      robot_(world, options.body, errors, TrueStart(options, errors), z_max_m, options.seed),
      stage_(world, options.actors),
      renderer_(world, options.camera, options.lighting.value_or(world->lighting())),
      sensor_(options.camera, WithGain(options.sensor, errors.gain)),
      noise_(options.seed, "pixels") {
  robot_.SetRough(options.rough);
}

Observation SimulatedRobot::Step(const motion::VelocityCommand& command) {
  Observation observation = StepBlind(command);
  observation.image = Look();
  return observation;
}

Observation SimulatedRobot::StepBlind(const motion::VelocityCommand& command) {
  robot_.Drive(command, period_s_, &stage_);
  const double time_s = static_cast<double>(steps_) * period_s_;
  stage_.Advance(time_s, robot_.true_pose());
  Observation observation;
  observation.stamp = FromSeconds(time_s);
  observation.odometry = robot_.odometry();
  observation.blocked = robot_.blocked();
  ++steps_;
  return observation;
}

Eigen::Isometry3d SimulatedRobot::BodyFromCameraNow() const {
  if (camera_.knock_yaw_deg == 0.0 || looks_at_s() < camera_.knock_at_s) return body_from_camera_;
  Eigen::Isometry3d knocked = body_from_camera_;
  const Eigen::AngleAxisd turn(Radians(camera_.knock_yaw_deg), Eigen::Vector3d::UnitZ());
  knocked.linear() = turn.toRotationMatrix() * body_from_camera_.linear();
  return knocked;
}

double SimulatedRobot::ExposureNow() const {
  const double phase_rad = 2.0 * std::numbers::pi * looks_at_s() / camera_.exposure_period_s;
  return std::pow(camera_.exposure_swing, std::sin(phase_rad));
}

image::GrayImage SimulatedRobot::Look() {
  const motion::VelocityCommand& velocity = robot_.true_velocity();
  const Eigen::Isometry3d body_from_camera = BodyFromCameraNow();
  const Eigen::Matrix3d camera_from_body = body_from_camera.linear().transpose();
  CameraMotion motion;
  motion.linear_mps =
      camera_from_body *
      Eigen::Vector3d(velocity.linear_mps, velocity.angular_radps * camera_.ahead_m, 0.0);
  motion.angular_radps = camera_from_body * Eigen::Vector3d(0.0, 0.0, velocity.angular_radps);
  const PerfectView& view =
      renderer_.Render(robot_.WorldFromBody() * body_from_camera, stage_.parts(), motion);
  return sensor_.Form(view, motion, noise_, ExposureNow());
}

}  // namespace trailcast::sim
