#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/motion/free_way.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// The measures of a robot, its scanner and its range sensors that matter for stopping before an
// obstacle. The robot reaches as far ahead of its axle as half its width, or to its scanner if that
// is further.
struct ObstacleOptions {
  double scan_ahead_m = 0.0;  // from the axle to the scanner
  double robot_width_m = 0.5;
  double gap_m = 0.3;  // between the standing robot and the obstacle
  // The pose of each range sensor, seen from the axle; without one it is in the middle of the
  // robot's front.
  std::vector<std::optional<motion::Pose2>> range_mounts;
};

// Returns its outline, with a margin on either side.
[[nodiscard]] motion::Outline OutlineOf(const ObstacleOptions& options);

// A range sensor's topic and mount.
struct RangeSensor {
  std::string topic;
  std::optional<motion::Pose2> mount;
};

// Parses "sonar", or "sonar@0.2,-0.1,-30": metres ahead of the axle and to the left, and degrees to
// the left of straight ahead.
[[nodiscard]] Result<RangeSensor> ParseRangeSensor(const std::string& text);

}  // namespace trailcast::agent
