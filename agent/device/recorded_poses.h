#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/odometry_gate.h"
#include "agent/device/pose_history.h"
#include "services/base/result.h"

namespace trailcast::agent {

// All odometry of a recorded drive without its jumps. The drive itself shows how fast its base can
// be.
class RecordedPoses {
 public:
  struct Sample {
    SensorTime taken{};
    motion::Pose2 pose;
  };
  // Samples whose times do not rise are left out.
  explicit RecordedPoses(const std::vector<Sample>& samples);

  // The history has at least one sample.
  [[nodiscard]] const PoseHistory& history() const { return history_; }
  // Returns the unknown motion over the jumps since the last call, up to `until`; times must rise.
  // It adds each jump's line for people to `news`.
  [[nodiscard]] motion::OdometryIncrement TakeUnknown(SensorTime until,
                                                      std::vector<std::string>& news);

 private:
  struct Jump {
    SensorTime taken{};
    OdometryJump jump;
  };
  PoseHistory history_{std::chrono::nanoseconds::max()};
  std::vector<Jump> jumps_;
  std::size_t taken_ = 0;  // how many of them were returned
};

// kInvalidArgument means that no base drives as fast as these samples say if they are in metres.
[[nodiscard]] Result<void> CheckSpeed(const std::vector<RecordedPoses::Sample>& samples);

}  // namespace trailcast::agent
