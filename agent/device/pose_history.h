#pragma once

#include <deque>
#include <optional>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Odometry, for the pose at the moment a frame was taken: that of the last seconds, or all of it.
class PoseHistory {
 public:
  explicit PoseHistory(std::chrono::nanoseconds kept = std::chrono::seconds(2)) : kept_(kept) {}

  // False for a sample that is not newer than the last one: it is left out.
  bool Add(SensorTime stamp, const motion::Pose2& pose);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  // The pose then, interpolated; before the oldest or after the newest sample, that one's.
  // Not empty.
  [[nodiscard]] motion::Pose2 At(SensorTime stamp) const;
  // How long before or after the nearest sample that is. Not empty.
  [[nodiscard]] std::chrono::nanoseconds FromNearest(SensorTime stamp) const;
  // Not empty.
  [[nodiscard]] SensorTime oldest() const { return samples_.front().stamp; }
  [[nodiscard]] SensorTime newest() const { return samples_.back().stamp; }

 private:
  struct Sample {
    SensorTime stamp{};
    motion::Pose2 pose;
  };
  // The first one that is not before `stamp`.
  [[nodiscard]] std::deque<Sample>::const_iterator NotBefore(SensorTime stamp) const;

  std::chrono::nanoseconds kept_;
  std::deque<Sample> samples_;
};

}  // namespace trailcast::agent
