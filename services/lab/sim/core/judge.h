#pragma once

#include <Eigen/Geometry>

#include "services/lab/sim/core/simulated_robot.h"
#include "services/motion/motion.h"

namespace trailcast::sim {

// The truth about a simulated robot, for those who measure it, drive the scout as its operator, or
// push it. A follower must never see this header.
class Judge {
 public:
  // Keeps a reference to `robot`.
  explicit Judge(SimulatedRobot& robot) : robot_(robot) {}

  // The pose is in the world frame.
  [[nodiscard]] const motion::Pose2& true_pose() const { return robot_.robot_.true_pose(); }
  // With height, roll and pitch from the ground.
  [[nodiscard]] Eigen::Isometry3d WorldFromBody() const { return robot_.robot_.WorldFromBody(); }
  [[nodiscard]] Eigen::Isometry3d WorldFromCamera() const {
    return WorldFromBody() * robot_.body_from_camera_;
  }
  [[nodiscard]] const motion::VelocityCommand& true_velocity() const {
    return robot_.robot_.true_velocity();
  }
  [[nodiscard]] bool blocked() const { return robot_.robot_.blocked(); }
  [[nodiscard]] bool blocked_by_actor() const { return robot_.robot_.blocked_by_actor(); }
  [[nodiscard]] const Stage& stage() const { return robot_.stage_; }

  // Moves the robot as if it were pushed, by metres in its own frame (x ahead, y left). Its wheels
  // do not turn, so odometry does not notice.
  void Shove(const motion::Pose2& by) { Carry(motion::Compose(true_pose(), by)); }
  // Moves it in the same way to a pose in the world frame.
  void Carry(const motion::Pose2& to) { robot_.robot_.PlaceAt(to); }

 private:
  SimulatedRobot& robot_;
};

}  // namespace trailcast::sim
