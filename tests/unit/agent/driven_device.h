#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "agent/device/device.h"
#include "tests/support/walk_frames.h"

namespace trailcast::test {

// This is a robot on the walk's straight path that drives as fast as it is commanded. Its frames
// show where it is, at 30 Hz of its own time, which runs three times as fast as real time.
class DrivenDevice : public agent::RobotDevice {
 public:
  std::atomic<double> along_m = 0.0;
  // The robot goes no further than this for the time being.
  std::atomic<double> wall_m = 1e9;

  Result<std::optional<agent::Observation>> Next() override {
    std::this_thread::sleep_until(due_);
    due_ = std::max(due_, std::chrono::steady_clock::now()) + kFrame;
    // The command counts for a frame. Pictures and odometry are a frame of the walk apart.
    along_m = std::min<double>(along_m + std::max(0.0, told_.linear_mps) / kRate_hz, wall_m);
    const int picture = static_cast<int>(std::lround(along_m / kStep_m));
    agent::Observation observation;
    observation.stamp = FromSeconds(count_++ / kRate_hz);
    observation.image = WalkFrame(picture);
    observation.odometry = motion::Pose2{kStep_m * picture, 0.0, 0.0};
    return observation;
  }
  Result<void> Drive(const motion::VelocityCommand& command) override {
    told_ = command;
    return {};
  }
  std::string camera() const override { return "walk 160x120"; }
  std::optional<double> drive_progress() const override { return std::nullopt; }

 private:
  static constexpr std::chrono::milliseconds kFrame{11};
  static constexpr double kRate_hz = 30.0;
  static constexpr double kStep_m = 0.02;  // between two pictures of the walk
  std::chrono::steady_clock::time_point due_;
  motion::VelocityCommand told_;
  int count_ = 0;
};

}  // namespace trailcast::test
