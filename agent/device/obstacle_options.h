#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/motion/free_way.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// A robot, its scanner and its range sensors, as far as standing before an obstacle goes. The robot
// is taken to reach as far ahead of its axle as half its width, or to its scanner if that is
// further.
struct ObstacleOptions {
  double scan_ahead_m = 0.0;  // from the axle to the scanner
  double robot_width_m = 0.5;
  double gap_m = 0.3;  // left between the robot and what it stands before
  // Where each range sensor is, seen from the axle; nothing: in the middle of its front.
  std::vector<std::optional<motion::Pose2>> range_mounts;
};

// Its outline, wider by what is to spare on either side.
[[nodiscard]] motion::Outline OutlineOf(const ObstacleOptions& options);

// A range sensor's topic, and where it is mounted.
struct RangeSensor {
  std::string topic;
  std::optional<motion::Pose2> mount;
};

// From "sonar", or "sonar@0.2,-0.1,-30": metres ahead of the axle and to the left, and degrees to
// the left of straight ahead.
[[nodiscard]] Result<RangeSensor> ParseRangeSensor(const std::string& text);

}  // namespace trailcast::agent
