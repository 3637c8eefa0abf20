#pragma once

#include <chrono>
#include <optional>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Tells by its odometry whether a robot, after it had moved, has stood for a while: its drive is
// over.
class StillWatch {
 public:
  // 0: it never is.
  explicit StillWatch(std::chrono::milliseconds limit) : limit_(limit) {}

  // At each frame; by the odometry's stamps.
  [[nodiscard]] bool Over(SensorTime stamp, const motion::Pose2& pose);

 private:
  std::chrono::milliseconds limit_;
  std::optional<motion::Pose2> place_;  // where it has been since `since_`
  SensorTime since_{};
  bool moved_ = false;
};

}  // namespace trailcast::agent
