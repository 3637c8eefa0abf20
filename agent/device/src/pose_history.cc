#include "agent/device/pose_history.h"

#include <algorithm>

namespace trailcast::agent {

bool PoseHistory::Add(SensorTime stamp, const motion::Pose2& pose) {
  if (!samples_.empty() && stamp <= samples_.back().stamp) return false;
  samples_.push_back({stamp, pose});
  while (stamp - samples_.front().stamp > kept_) samples_.pop_front();
  return true;
}

std::deque<PoseHistory::Sample>::const_iterator PoseHistory::NotBefore(SensorTime stamp) const {
  return std::lower_bound(
      samples_.begin(), samples_.end(), stamp,
      [](const Sample& sample, SensorTime time) { return sample.stamp < time; });
}

std::chrono::nanoseconds PoseHistory::FromNearest(SensorTime stamp) const {
  const auto after = NotBefore(stamp);
  auto nearest = std::chrono::nanoseconds::max();
  if (after != samples_.end()) nearest = after->stamp - stamp;
  if (after != samples_.begin()) nearest = std::min(nearest, stamp - std::prev(after)->stamp);
  return nearest;
}

motion::Pose2 PoseHistory::At(SensorTime stamp) const {
  const auto after = NotBefore(stamp);
  if (after == samples_.begin()) return samples_.front().pose;
  if (after == samples_.end()) return samples_.back().pose;
  const Sample& before = *std::prev(after);
  return motion::Interpolate(before.pose, after->pose,
                             Seconds(stamp - before.stamp) / Seconds(after->stamp - before.stamp));
}

}  // namespace trailcast::agent
