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

// The robot behind the agent, as given on the command line.
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
  std::optional<double> camera_ahead_m;  // likewise; see ReplayMethodOptions
  double pass_obstacles_m = 0.0;         // see PassingOptions::most_m

  [[nodiscard]] bool is_simulated() const { return !simulated.place.world.empty(); }
  [[nodiscard]] bool is_recorded() const { return !recorded.frames.empty() || !bag.bag.empty(); }
};

enum class DeviceUse : std::uint8_t { kTeach, kReplay, kOnDuty };

// Adds flags to `command`, of which one of --frames, --bag, --sim and --ros2 is required. A scout
// has others: a speed if it is simulated, the end of its drive if it is real. An agent that waits
// for missions has no recordings.
void AddDeviceOptions(CLI::App& command, DeviceOptions& options, DeviceUse use);

// Adds the flags of a recording: --frames and what belongs to it, and --bag, which exclude each
// other.
struct RecordingFlags {
  CLI::Option* frames = nullptr;
  CLI::Option* bag = nullptr;
};
RecordingFlags AddRecordingOptions(CLI::App& command, RecordedRun& recorded, BagRun& bag);

// The topics' options, which require the option `robot`, also apply to a recording, which finds its
// own topics without them. TakeTopics copies the given ones into `bag`.
void ShareTopics(CLI::App& command, CLI::Option* robot);
void TakeTopics(const CLI::App& command, const dds::Ros2Options& topics, BagRun& bag);

// Adds the flags of a simulated robot and returns the one that names the world.
CLI::Option* AddSimulatedOptions(CLI::App& command, DeviceOptions& options, bool scout);

// These check how far ahead a camera is, and how it is rolled.
[[nodiscard]] CLI::Validator CameraAheadRange();
[[nodiscard]] CLI::Validator CameraRollValidator();

// Adds the flag that tells how the camera is rolled.
void AddCameraRoll(CLI::App& command, vision::IntakeOptions& intake);

// Adds flags for what a real robot's base can do; they require the option `robot`.
void AddDriveLimits(CLI::App& command, CLI::Option* robot, motion::DriveLimits& limits);

// Adds flags for the topics of a ROS 2 robot; they require the option `robot`.
void AddRos2TopicOptions(CLI::App& command, CLI::Option* robot, const std::string& group,
                         dds::Ros2Options& topics);

// Adds the flag of a scanner's topic, which is optional; it requires the option `robot`.
CLI::Option* AddScanTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                dds::Ros2Options& topics);

// Adds the flag of range sensors, each with an optional mount. `topics.ranges` and `mounts` have
// the same number and order.
CLI::Option* AddRangeTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                 dds::Ros2Options& topics,
                                 std::vector<std::optional<motion::Pose2>>& mounts);

// Adds both, and the measures of the robot that are needed to judge their readings.
void AddObstacleSensorOptions(CLI::App& command, CLI::Option* robot, dds::Ros2Options& topics,
                              ObstacleOptions& obstacles);

// Adds the flag of an IMU's topic likewise.
CLI::Option* AddImuTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                               dds::Ros2Options& topics);

// Adds the flag of its battery's topic.
CLI::Option* AddBatteryTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                   dds::Ros2Options& topics);

// Puts the robot's topics on the network's interface if they name none.
void JoinNetwork(dds::Ros2Options& topics, const program::CommonOptions& network);

struct OpenedDevice {
  std::unique_ptr<RobotDevice> device;
  const SimulatedRobot* simulated = nullptr;  // the same device, if it is simulated

  // Says, after the run, whether a simulated robot's true poses were written.
  [[nodiscard]] Result<void> TruthWritten() const;
};

[[nodiscard]] Result<OpenedDevice> OpenDevice(const DeviceOptions& options,
                                              const program::CommonOptions& network);

}  // namespace trailcast::agent
