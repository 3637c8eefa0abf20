#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/device.h"

namespace trailcast::agent {

struct BagRun {
  std::filesystem::path bag;               // a file, or the folder of a rosbag2 recording
  std::optional<std::string> image_topic;  // nothing: the only one with pictures
  std::optional<std::string> odom_topic;   // nothing: the only one, if any; empty: none
  // Frames tell what the base was told (Observation::heard), by the topic that is named or by the
  // only one with commands, if there is one.
  bool hear_commands = false;
  std::optional<std::string> command_topic{};
};

// A drive that a robot's own tools recorded (services/bag), as fast as it can be read. Frames have
// the times that the robot gave them, made to go forward as on the wire (recorded_clock.h), and the
// odometry of those times. Pictures that cannot be read, that come after a later one, or that were
// taken more than half a second from any odometry are left out, which is told at the end: how many,
// and how far the robot drove meanwhile. What it is told to drive has no effect.
class BagDevice final : public RobotDevice {
 public:
  // Reads all odometry, when pictures were taken, and the first of them already. Errors list the
  // topics that there are.
  [[nodiscard]] static Result<std::unique_ptr<BagDevice>> Open(const BagRun& run);
  ~BagDevice() override;

  [[nodiscard]] Result<std::optional<Observation>> Next() override;
  [[nodiscard]] Result<void> Drive(const motion::VelocityCommand&) override { return {}; }
  [[nodiscard]] std::vector<std::string> TakeNews() override;
  [[nodiscard]] std::string camera() const override;
  [[nodiscard]] std::optional<double> drive_progress() const override;

  // For people: which topics are read.
  [[nodiscard]] std::string sources() const;

 private:
  struct State;
  explicit BagDevice(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::agent
