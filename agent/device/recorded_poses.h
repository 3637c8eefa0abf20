#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/odometry_gate.h"
#include "agent/device/pose_history.h"

namespace trailcast::agent {

// All odometry of a recorded drive, without its jumps: how fast a base can be, it shows itself.
class RecordedPoses {
 public:
  struct Sample {
    SensorTime taken{};
    motion::Pose2 pose;
  };
  // Times that do not rise are left out.
  explicit RecordedPoses(const std::vector<Sample>& samples);

  // At least one sample is kept.
  [[nodiscard]] const PoseHistory& history() const { return history_; }
  // What may have been driven over the jumps up to then, since the last call; times rise. Each
  // jump's line for people is added to `news`.
  [[nodiscard]] motion::OdometryIncrement TakeUnknown(SensorTime until,
                                                      std::vector<std::string>& news);

 private:
  struct Jump {
    SensorTime taken{};
    OdometryJump jump;
  };
  PoseHistory history_{std::chrono::nanoseconds::max()};
  std::vector<Jump> jumps_;
  std::size_t taken_ = 0;  // of them
};

}  // namespace trailcast::agent
