#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "services/lab/sim/core/bumps.h"
#include "services/lab/sim/core/disturbances.h"
#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/stage.h"
#include "services/lab/sim/core/world.h"
#include "services/motion/motion.h"

namespace trailcast::sim {

// The drawing of the robot, from which single robots differ (RobotErrors).
struct RobotBody {
  double wheel_base_m = 0.34;  // between the wheels' middles
  double length_m = 0.30;      // between front and rear contact
  double radius_m = 0.20;      // of the body that bumps into things
  double top_speed_mps = 1.0;  // of a wheel
  double acceleration_mps2 = 1.2;
  // It steers like a car, no tighter than this; with 0 it steers by its two driven wheels.
  double turn_radius_m = 0.0;
};

// A robot on two driven wheels, or with a steering axle in front of them: its true place, and its
// wheels' odometry.
class DifferentialDriveRobot {
 public:
  // It stands at `start` (world frame), on the surface below `z_max_m`.
  DifferentialDriveRobot(std::shared_ptr<const World> world, const RobotBody& body,
                         const RobotErrors& errors, const motion::Pose2& start, double z_max_m,
                         std::uint64_t seed);

  // Drives for `duration_s`, in which the wheels approach the commanded speeds. `actors` block it
  // as walls do.
  void Drive(const motion::VelocityCommand& command, double duration_s,
             const Stage* actors = nullptr);

  // Returns the robot's own knowledge: wheel odometry from where it was switched on.
  [[nodiscard]] const motion::Pose2& odometry() const { return odometry_; }

  // The truth is for rendering and for judges.
  [[nodiscard]] const motion::Pose2& true_pose() const { return pose_; }
  // The body frame (x ahead, y left, z up) is on the ground and tilted with it.
  [[nodiscard]] Eigen::Isometry3d WorldFromBody() const;
  // The true linear (along x) and angular velocity during the last step.
  [[nodiscard]] const motion::VelocityCommand& true_velocity() const { return velocity_; }
  // Says whether it was blocked in the last step; its wheels turned nevertheless.
  [[nodiscard]] bool blocked() const { return blocked_by_ != Obstacle::kNone; }
  [[nodiscard]] bool blocked_by_actor() const { return blocked_by_ == Obstacle::kActor; }
  // Carries it to another place by hand, which odometry does not notice.
  void PlaceAt(const motion::Pose2& pose);
  // Sets the share of each wheel's turning that moves the robot, 1 on good ground. Odometry does
  // not notice.
  void SetGrip(double left, double right) { grip_ = {left, right}; }
  // Adds bumps that its wheels feel to the world's ground.
  void SetRough(std::vector<RoughPatch> patches);

 private:
  struct Wheels {
    double left = 0.0;
    double right = 0.0;
  };
  [[nodiscard]] Wheels Wanted(const motion::VelocityCommand& command, double duration_s);
  [[nodiscard]] double Steer(const motion::VelocityCommand& command, double duration_s);
  enum class Obstacle { kNone, kWorld, kActor };
  [[nodiscard]] Obstacle FeelAhead(double step_m, const Stage* actors) const;
  void StandOnGround();

  std::shared_ptr<const World> world_;
  RobotBody body_;
  RobotErrors errors_;
  Random slip_;
  motion::Pose2 pose_;
  motion::Pose2 odometry_;
  motion::VelocityCommand velocity_;
  double left_mps_ = 0.0;  // wheel speeds as the encoders measure them
  double right_mps_ = 0.0;
  double curvature_per_m_ = 0.0;  // the steering axle's
  Wheels grip_{1.0, 1.0};
  std::vector<RoughPatch> rough_;
  double z_m_ = 0.0;
  double roll_rad_ = 0.0;   // right side down is positive
  double pitch_rad_ = 0.0;  // nose down is positive
  Obstacle blocked_by_ = Obstacle::kNone;
};

}  // namespace trailcast::sim
