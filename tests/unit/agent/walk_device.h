#pragma once

#include <functional>
#include <vector>

#include "agent/device/device.h"
#include "tests/support/walk_frames.h"

namespace trailcast::test {

// This is a robot that walks straight on whatever it is commanded, and notes the commands.
class WalkDevice : public agent::RobotDevice {
 public:
  explicit WalkDevice(int frames) : frames_(frames) {}

  // This is called before each frame with its number. An error is the camera's.
  std::function<Result<void>(int)> before_frame = [](int) { return Result<void>{}; };
  // This is its odometry with a frame.
  std::function<motion::Pose2(int)> odometry = [](int frame) {
    return motion::Pose2{0.02 * frame, 0.0, 0.0};
  };
  std::vector<motion::ImuSample> imu;  // its IMU's samples with each frame; empty without an IMU
  std::vector<motion::VelocityCommand> told;
  int next = 0;
  bool blind = false;  // the lens is covered

  Result<std::optional<agent::Observation>> Next() override {
    if (auto ok = before_frame(next); !ok) return tl::unexpected(ok.error());
    if (next == frames_) return std::nullopt;
    agent::Observation observation;
    observation.stamp = FromSeconds(next / 30.0);
    observation.image = WalkFrame(next);
    if (blind) observation.image.pixels.assign(observation.image.pixels.size(), 0);
    observation.odometry = odometry(next);
    observation.imu = imu;
    ++next;
    return observation;
  }
  Result<void> Drive(const motion::VelocityCommand& command) override {
    told.push_back(command);
    return {};
  }
  std::string camera() const override { return "walk 160x120"; }
  std::optional<double> drive_progress() const override {
    return static_cast<double>(next) / frames_;
  }

 private:
  int frames_;
};

}  // namespace trailcast::test
