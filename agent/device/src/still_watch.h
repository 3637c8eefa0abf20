#pragma once

#include <chrono>
#include <optional>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Says by odometry whether a robot has moved and then stood for a while, so that its drive is over.
class StillWatch {
 public:
  // With a `limit` of 0 it never is.
  explicit StillWatch(std::chrono::milliseconds limit) : limit_(limit) {}

  // Takes each frame's pose, at the odometry's stamp.
  [[nodiscard]] bool Over(SensorTime stamp, const motion::Pose2& pose);

 private:
  std::chrono::milliseconds limit_;
  std::optional<motion::Pose2> place_;  // where it has been since `since_`
  SensorTime since_{};
  bool moved_ = false;
};

}  // namespace trailcast::agent
