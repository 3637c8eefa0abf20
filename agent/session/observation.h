#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/base/time.h"
#include "services/image/image.h"
#include "services/motion/imu.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// This is what a robot senses at one instant: one camera frame, and wheel odometry if there is any.
struct Observation {
  SensorTime stamp{0};
  image::GrayImage image;
  std::optional<motion::Pose2> odometry;  // in the odometry's own frame
  // The robot may have driven and turned this far since the last frame, in either direction, beside
  // what odometry says, because odometry has jumped or was silent.
  motion::OdometryIncrement unknown{};
  std::vector<motion::ImuSample> imu{};  // since the last frame, of a robot with an IMU
  // This is where obstacles stand by its scanner's newest scan, in the axle's frame: x ahead, y
  // left. It is empty without a scanner.
  std::optional<std::vector<Eigen::Vector2d>> stands{};
  // This is the command to the base since the last frame. It is empty if commands move no robot, as
  // in a recording.
  std::optional<motion::VelocityCommand> told{};
  // This is the last command to the base that was heard from another program. It is empty if there
  // was none, or only long ago, or if the device was not asked to listen.
  std::optional<motion::VelocityCommand> heard{};
};

}  // namespace trailcast::agent
