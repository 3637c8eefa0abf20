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

// The drawing of the robot; single ones differ from it (RobotErrors).
struct RobotBody {
  double wheel_base_m = 0.34;  // between the wheels' middles
  double length_m = 0.30;      // between front and rear contact
  double radius_m = 0.20;      // of what bumps into things
  double top_speed_mps = 1.0;  // of a wheel
  double acceleration_mps2 = 1.2;
  // Steers like a car, no tighter than this; 0: by its two driven wheels.
  double turn_radius_m = 0.0;
};

// A robot on two driven wheels, or with a steering axle in front of them: where it truly is, and
// what its wheels tell it.
class DifferentialDriveRobot {
 public:
  // Stands at `start` (world frame), on the surface below `z_max_m`.
  DifferentialDriveRobot(std::shared_ptr<const World> world, const RobotBody& body,
                         const RobotErrors& errors, const motion::Pose2& start, double z_max_m,
                         std::uint64_t seed);

  // Drives for `duration_s` with the wheels heading for the commanded speeds.
  // `actors` stand in its way as walls do.
  void Drive(const motion::VelocityCommand& command, double duration_s,
             const Stage* actors = nullptr);

  // What the robot itself knows: wheel odometry from where it was switched on.
  [[nodiscard]] const motion::Pose2& odometry() const { return odometry_; }

  // The truth, for rendering and for judges.
  [[nodiscard]] const motion::Pose2& true_pose() const { return pose_; }
  // Body frame (x ahead, y left, z up) on the ground, tilted as the ground is.
  [[nodiscard]] Eigen::Isometry3d WorldFromBody() const;
  // True linear (along x) and angular velocity during the last step.
  [[nodiscard]] const motion::VelocityCommand& true_velocity() const { return velocity_; }
  // Stood against something in the last step; the wheels turned all the same.
  [[nodiscard]] bool blocked() const { return blocked_by_ != Obstacle::kNone; }
  [[nodiscard]] bool blocked_by_actor() const { return blocked_by_ == Obstacle::kActor; }
  // Carried to another place by hand; odometry does not notice.
  void PlaceAt(const motion::Pose2& pose);
  // So much of what each wheel turns moves the robot, 1 on good ground; odometry does not notice.
  void SetGrip(double left, double right) { grip_ = {left, right}; }
  // What its wheels feel besides the world's ground.
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
  double left_mps_ = 0.0;  // wheel speeds as the encoders see them
  double right_mps_ = 0.0;
  double curvature_per_m_ = 0.0;  // a steering axle's
  Wheels grip_{1.0, 1.0};
  std::vector<RoughPatch> rough_;
  double z_m_ = 0.0;
  double roll_rad_ = 0.0;   // right side down is positive
  double pitch_rad_ = 0.0;  // nose down is positive
  Obstacle blocked_by_ = Obstacle::kNone;
};

}  // namespace trailcast::sim
