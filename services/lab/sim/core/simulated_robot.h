#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "services/base/result.h"
#include "services/base/time.h"
#include "services/image/image.h"
#include "services/lab/sim/core/camera.h"
#include "services/lab/sim/core/disturbances.h"
#include "services/lab/sim/core/image_formation.h"
#include "services/lab/sim/core/robot.h"
#include "services/lab/sim/core/stage.h"
#include "services/lab/sim/core/world.h"
#include "services/motion/motion.h"

namespace trailcast::sim {

struct SimulatedRobotOptions {
  CameraModel camera;
  motion::Pose2 start;  // world frame; the drawn start error comes on top
  // The robot stands on the highest surface below this or, without it, on the floor.
  std::optional<double> start_z_max_m;
  Disturbances disturbances;
  std::uint64_t seed = 1;
  // The seed of its body and camera; without it they come from `seed`, as start and noise do.
  std::optional<std::uint64_t> robot_seed;
  RobotBody body;
  SensorOptions sensor;
  double rate_hz = 30.0;
  std::optional<Lighting> lighting;  // without it, the world's own
  Actors actors;                     // by this robot's clock; the world itself does not change
  std::vector<RoughPatch> rough{};   // bumps in addition to the world's ground
};

// Everything that a robot learns in a step.
struct Observation {
  SensorTime stamp{};
  image::GrayImage image;
  motion::Pose2 odometry;  // in the frame of where it was switched on
  bool blocked = false;    // its bumper is pressed
};

// A robot with a camera in a world, in lockstep: time passes only in Step. The same options and
// commands give the same observations bit for bit. It is single-threaded, but several robots may
// share a world and run on threads of their own. The truth is in judge.h.
class SimulatedRobot {
 public:
  // Fails on an impossible camera or rate, and if there is no ground to start on.
  [[nodiscard]] static Result<std::unique_ptr<SimulatedRobot>> Create(
      const std::shared_ptr<const World>& world, const SimulatedRobotOptions& options);

  // Obeys `command` for one period of the clock, then takes a picture. A first Step({}) is a look
  // at the start, standing.
  [[nodiscard]] Observation Step(const motion::VelocityCommand& command);
  // Does the same without a picture: `image` is empty.
  [[nodiscard]] Observation StepBlind(const motion::VelocityCommand& command);

  // Sets the share of each wheel's turning that moves the robot, 1 on good ground.
  void SetGrip(double left, double right) { robot_.SetGrip(left, right); }

 private:
  friend class Judge;
  SimulatedRobot(const std::shared_ptr<const World>& world, const SimulatedRobotOptions& options,
                 const RobotErrors& errors, double z_max_m);
  [[nodiscard]] image::GrayImage Look();
  [[nodiscard]] double looks_at_s() const { return static_cast<double>(steps_ - 1) * period_s_; }
  [[nodiscard]] Eigen::Isometry3d BodyFromCameraNow() const;
  [[nodiscard]] double ExposureNow() const;

  CameraModel camera_;
  double period_s_;
  Eigen::Isometry3d body_from_camera_;
  DifferentialDriveRobot robot_;
  Stage stage_;
  CameraRenderer renderer_;
  ImageFormation sensor_;
  Random noise_;
  std::int64_t steps_ = 0;
};

}  // namespace trailcast::sim
