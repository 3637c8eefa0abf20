#pragma once

#include <deque>
#include <optional>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// The last seconds of odometry, for the pose at the moment a frame was taken.
class PoseHistory {
 public:
  // False for a sample that is not newer than the last one: it is left out.
  bool Add(SensorTime stamp, const motion::Pose2& pose);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  // The pose then, interpolated; before the oldest or after the newest sample, that one's.
  // Not empty.
  [[nodiscard]] motion::Pose2 At(SensorTime stamp) const;
  // Not empty.
  [[nodiscard]] SensorTime newest() const { return samples_.back().stamp; }

 private:
  struct Sample {
    SensorTime stamp{};
    motion::Pose2 pose;
  };
  std::deque<Sample> samples_;
};

}  // namespace trailcast::agent
