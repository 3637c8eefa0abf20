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
  // The robot stands on the highest surface below this; nothing: on the floor there.
  std::optional<double> start_z_max_m;
  Disturbances disturbances;
  std::uint64_t seed = 1;
  // Whose body and camera are drawn; nothing: those of `seed`, which also gives start and noise.
  std::optional<std::uint64_t> robot_seed;
  RobotBody body;
  SensorOptions sensor;
  double rate_hz = 30.0;
  std::optional<Lighting> lighting;  // nothing: the world's own
  Actors actors;                     // by this robot's clock; the world itself stays as it is
  std::vector<RoughPatch> rough{};   // what its wheels feel besides the world's ground
};

// What a robot gets to know in a step, and all that it gets to know.
struct Observation {
  SensorTime stamp{};
  image::GrayImage image;
  motion::Pose2 odometry;  // in the frame of where it was switched on
  bool blocked = false;    // its bumper is pressed
};

// A robot with a camera in a world, in lockstep: time passes only in Step. The same options give
// the same observations bit for bit for the same commands. Single-threaded; several robots may
// share a world and run in threads of their own. Truth is not here but in judge.h.
class SimulatedRobot {
 public:
  // Fails on an impossible camera, on a rate that is none, and where there is no ground to start
  // on.
  [[nodiscard]] static Result<std::unique_ptr<SimulatedRobot>> Create(
      const std::shared_ptr<const World>& world, const SimulatedRobotOptions& options);

  // Obeys `command` for one period of the clock, then looks. A first Step({}) is a look at the
  // start, standing.
  [[nodiscard]] Observation Step(const motion::VelocityCommand& command);
  // The same without looking: `image` is empty.
  [[nodiscard]] Observation StepBlind(const motion::VelocityCommand& command);

  // So much of what each wheel turns moves the robot, 1 on good ground.
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
