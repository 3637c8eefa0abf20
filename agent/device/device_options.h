#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/bag_device.h"
#include "agent/device/recorded_device.h"
#include "agent/device/ros2_device.h"
#include "agent/device/simulated_robot.h"
#include "services/program/command_line.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

// Which robot is behind the agent, as the command line says it.
struct DeviceOptions {
  RecordedRun recorded;
  BagRun bag;
  SimulatedRun simulated;
  Ros2Run ros2;
  double sensor_timeout_s = 0.3;
  double sensor_patience_s = 10.0;
  double base_patience_s = 30.0;
  double still_at_end_s = 0.0;
  vision::IntakeOptions intake;          // how its camera is mounted
  std::optional<double> camera_ahead_m;  // the same, as ReplayMethodOptions has it
  double pass_obstacles_m = 0.0;         // as PassingOptions::most_m

  [[nodiscard]] bool is_simulated() const { return !simulated.place.world.empty(); }
  [[nodiscard]] bool is_recorded() const { return !recorded.frames.empty() || !bag.bag.empty(); }
};

enum class DeviceUse : std::uint8_t { kTeach, kReplay, kOnDuty };

// Flags of `command`; one of --frames, --bag, --sim and --ros2 is required. The scout's differ: a
// simulated one is told a speed, a real one when its drive is over. On duty are no recordings.
void AddDeviceOptions(CLI::App& command, DeviceOptions& options, DeviceUse use);

// Adds those of them for a recording: --frames with what goes with it, and --bag, which exclude
// each other.
struct RecordingFlags {
  CLI::Option* frames = nullptr;
  CLI::Option* bag = nullptr;
};
RecordingFlags AddRecordingOptions(CLI::App& command, RecordedRun& recorded, BagRun& bag);

// The topics' options, which need the option `robot`, are also a recording's, which finds its own
// where nothing is said: `bag` takes what the command line says.
void ShareTopics(CLI::App& command, CLI::Option* robot);
void TakeTopics(const CLI::App& command, const dds::Ros2Options& topics, BagRun& bag);

// Those of them for a simulated robot. Returns the one that names the world.
CLI::Option* AddSimulatedOptions(CLI::App& command, DeviceOptions& options, bool scout);

// How far ahead a camera may be, and how it may be rolled.
[[nodiscard]] CLI::Validator CameraAheadRange();
[[nodiscard]] CLI::Validator CameraRollValidator();

// The one of them that says how the camera is rolled.
void AddCameraRoll(CLI::App& command, vision::IntakeOptions& intake);

// Those of them that say what the base of a real robot can do; they need the option `robot`.
void AddDriveLimits(CLI::App& command, CLI::Option* robot, motion::DriveLimits& limits);

// Those of them that say which topics a ROS 2 robot has; they need the option `robot`.
void AddRos2TopicOptions(CLI::App& command, CLI::Option* robot, const std::string& group,
                         dds::Ros2Options& topics);

// The one of a scanner, of which there need be none; it needs the option `robot`.
CLI::Option* AddScanTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                dds::Ros2Options& topics);

// The one of its range sensors, each of which may be given with its mount. Their number and order
// are those of `topics.ranges` and `mounts`.
CLI::Option* AddRangeTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                 dds::Ros2Options& topics,
                                 std::vector<std::optional<motion::Pose2>>& mounts);

// Both, and what has to be known of the robot to judge what they see.
void AddObstacleSensorOptions(CLI::App& command, CLI::Option* robot, dds::Ros2Options& topics,
                              ObstacleOptions& obstacles);

// The same of an IMU.
CLI::Option* AddImuTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                               dds::Ros2Options& topics);

// The one of its battery.
CLI::Option* AddBatteryTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                   dds::Ros2Options& topics);

// The robot's topics, if they name no interface, are on the network's.
void JoinNetwork(dds::Ros2Options& topics, const program::CommonOptions& network);

struct OpenedDevice {
  std::unique_ptr<RobotDevice> device;
  const SimulatedRobot* simulated = nullptr;  // the same, where it is one

  // After the run: whether a simulated robot's true poses are where they were asked for.
  [[nodiscard]] Result<void> TruthWritten() const;
};

[[nodiscard]] Result<OpenedDevice> OpenDevice(const DeviceOptions& options,
                                              const program::CommonOptions& network);

}  // namespace trailcast::agent
