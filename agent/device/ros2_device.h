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
  // With a scan topic or range topics, the robot stops before obstacles.
  ObstacleOptions obstacles;
  // A longer silence of the camera, odometry, scanner, range sensors or base stops the robot. In
  // lockstep the robot's time stands meanwhile, so only `patience` counts.
  std::chrono::milliseconds sensor_timeout{300};
  // How long a stopped robot waits for what fell silent, and the agent for the robot to appear.
  std::chrono::milliseconds patience{10'000};
  // How long a base may stand in spite of its commands (a safety stop, an emergency stop, an
  // obstacle) until that is final. Meanwhile it is told to stop, and tried now and then, gently.
  std::chrono::milliseconds base_patience{30'000};
  // Commands are kept within these.
  motion::DriveLimits limits;
  // The robot waits for a command with its frame's stamp, so each frame must be answered, even
  // while teaching.
  bool lockstep = false;
  // The drive is over when the robot has moved and then stood for so long; with 0 it never is.
  // Odometry tells this, or the pictures of a robot without it, by their stamps.
  std::chrono::milliseconds still_at_end{0};
  // Called while waiting for the robot; true ends the drive.
  std::function<bool()> stop = [] { return false; };
  // Tells the time for everything but the robot's own stamps. Two threads call it.
  std::function<std::chrono::steady_clock::time_point()> clock = std::chrono::steady_clock::now;
};

// A ROS 2 robot over DDS, without ROS. A thread of its own hears the robot. It tells the robot to
// stop shortly after sensor_timeout if something fails (RobotWatch), or if the loop that drives
// hangs. Next then waits for the failed part to come back, at most `patience`. An obstacle
// (ObstacleWatch) is no failure: Next waits until it is gone, but only reports it if a person
// drives the robot.
class Ros2Device final : public RobotDevice {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Ros2Device>> Open(const Ros2Run& run);
  // Takes a driver that is open, without the checks that Open makes.
  Ros2Device(const Ros2Run& run, std::unique_ptr<dds::Ros2Driver> driver);
  ~Ros2Device() override;

  [[nodiscard]] Result<std::optional<Observation>> Next() override;
  // While something is wrong, the robot is told to stop, whatever `command` is.
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
