#include "agent/device/src/pose_history.h"

#include <algorithm>

namespace trailcast::agent {
namespace {

constexpr std::chrono::seconds kKept{2};

}  // namespace

bool PoseHistory::Add(SensorTime stamp, const motion::Pose2& pose) {
  if (!samples_.empty() && stamp <= samples_.back().stamp) return false;
  samples_.push_back({stamp, pose});
  while (stamp - samples_.front().stamp > kKept) samples_.pop_front();
  return true;
}

motion::Pose2 PoseHistory::At(SensorTime stamp) const {
  const auto after =
      std::lower_bound(samples_.begin(), samples_.end(), stamp,
                       [](const Sample& sample, SensorTime time) { return sample.stamp < time; });
  if (after == samples_.begin()) return samples_.front().pose;
  if (after == samples_.end()) return samples_.back().pose;
  const Sample& before = *std::prev(after);
  return motion::Interpolate(before.pose, after->pose,
                             Seconds(stamp - before.stamp) / Seconds(after->stamp - before.stamp));
}

}  // namespace trailcast::agent
