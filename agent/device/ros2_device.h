#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/device.h"
#include "agent/device/obstacle_options.h"
#include "services/dds/ros2_link.h"
#include "services/motion/drive_limits.h"

namespace trailcast::agent {

struct Ros2Run {
  dds::Ros2Options topics;
  std::string camera = "camera";  // for people
  // With a scan topic or range topics, the robot stands before what is in its way.
  ObstacleOptions obstacles;
  // Silence of camera, odometry, scanner, range sensors or base for longer stops the robot. In
  // lockstep the robot's time stands meanwhile, and only the patience counts.
  std::chrono::milliseconds sensor_timeout{300};
  // How long a stopped robot waits for what fell silent, and the agent for the robot to appear.
  std::chrono::milliseconds patience{10'000};
  // How long a base may stand against its commands (a safety stop, an emergency stop, an obstacle)
  // until that is final. Meanwhile it is told to stand, and tried now and then, gently.
  std::chrono::milliseconds base_patience{30'000};
  // Commands are brought within these.
  motion::DriveLimits limits;
  // The robot waits for a command with the stamp of its frame: answer each, even while teaching.
  bool lockstep = false;
  // The drive is over when the robot, after having moved, has stood for so long; 0: it never is.
  // By odometry, by the pictures of a robot that has none, and by their stamps.
  std::chrono::milliseconds still_at_end{0};
  // Asked while waiting for the robot: the drive is over.
  std::function<bool()> stop = [] { return false; };
  // Tells the time for all but the robot's own stamps. Two threads ask it.
  std::function<std::chrono::steady_clock::time_point()> clock = std::chrono::steady_clock::now;
};

// A ROS 2 robot over DDS, without ROS. A thread of its own hears the robot, and tells it to stand
// within a moment of sensor_timeout when something fails (RobotWatch), or when the loop that
// drives it hangs; Next then waits for what failed to come back, at most `patience`. Something in
// the way (ObstacleWatch) is no failure: for that Next waits until it is gone; of a robot that is
// driven by hand it only tells.
class Ros2Device final : public RobotDevice {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Ros2Device>> Open(const Ros2Run& run);
  // This takes a driver that is open already, and does not look at what Open refuses.
  Ros2Device(const Ros2Run& run, std::unique_ptr<dds::Ros2Driver> driver);
  ~Ros2Device() override;

  [[nodiscard]] Result<std::optional<Observation>> Next() override;
  // While something is wrong the robot is told to stand, whatever `command` says.
  [[nodiscard]] Result<void> Drive(const motion::VelocityCommand& command) override;
  [[nodiscard]] std::string camera() const override;
  [[nodiscard]] std::optional<double> drive_progress() const override { return std::nullopt; }
  [[nodiscard]] std::optional<std::uint8_t> battery_percent() const override;
  [[nodiscard]] std::vector<std::string> TakeNews() override;
  void OnTrouble(const Trouble& tell) override;
  void ByHand(bool begins) override;
  [[nodiscard]] Result<image::GrayImage> Look() override;
  [[nodiscard]] std::string Ailment() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::agent
