#pragma once

#include <deque>
#include <optional>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Odometry of the last seconds, or all of it, to look up the pose at the moment a frame was taken.
class PoseHistory {
 public:
  explicit PoseHistory(std::chrono::nanoseconds kept = std::chrono::seconds(2)) : kept_(kept) {}

  // Adds a sample. It leaves out one that is not newer than the last, and returns false.
  bool Add(SensorTime stamp, const motion::Pose2& pose);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  // Returns the interpolated pose; before the oldest and after the newest sample, that one's. Needs
  // a sample.
  [[nodiscard]] motion::Pose2 At(SensorTime stamp) const;
  // Returns the time to the nearest sample. Needs a sample.
  [[nodiscard]] std::chrono::nanoseconds FromNearest(SensorTime stamp) const;
  // Both need a sample.
  [[nodiscard]] SensorTime oldest() const { return samples_.front().stamp; }
  [[nodiscard]] SensorTime newest() const { return samples_.back().stamp; }

 private:
  struct Sample {
    SensorTime stamp{};
    motion::Pose2 pose;
  };
  // Returns the first sample that is not before `stamp`.
  [[nodiscard]] std::deque<Sample>::const_iterator NotBefore(SensorTime stamp) const;

  std::chrono::nanoseconds kept_;
  std::deque<Sample> samples_;
};

}  // namespace trailcast::agent
