#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/base/time.h"
#include "services/image/image.h"
#include "services/motion/imu.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// What a robot senses at one instant: one camera frame, and wheel odometry where there is any.
struct Observation {
  SensorTime stamp{0};
  image::GrayImage image;
  std::optional<motion::Pose2> odometry;  // in the odometry's own frame
  // How far the robot may have driven and turned since the last frame, one way or the other,
  // besides what odometry says: where that has jumped, or was silent.
  motion::OdometryIncrement unknown{};
  std::vector<motion::ImuSample> imu{};  // since the last frame, of a robot that has one
  // Where something stands, by its scanner's newest look, seen from its axle: x ahead, y left;
  // nothing: it has no scanner.
  std::optional<std::vector<Eigen::Vector2d>> stands{};
  // The base was told to drive so since the last frame; nothing: commands move nobody (a
  // recording).
  std::optional<motion::VelocityCommand> told{};
  // What somebody else was last heard to tell the base; nothing: nobody was, or long ago, or the
  // device was not asked to listen.
  std::optional<motion::VelocityCommand> heard{};
};

}  // namespace trailcast::agent
