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
  std::optional<std::string> image_topic;  // nothing stands for the only one with pictures
  std::optional<std::string> odom_topic;   // nothing stands for the only one, if any; empty for
                                           // none
  // Frames tell the base's commands (Observation::heard), from the topic that is named or from the
  // only one with commands, if there is one.
  bool hear_commands = false;
  std::optional<std::string> command_topic{};
};

// A drive that a robot's own tools recorded (services/bag), read as fast as possible. Frames have
// the robot's times, made to rise as those on the wire are (recorded_clock.h), and the odometry of
// those times. It leaves out pictures that cannot be read, that come after a later one, or that
// were taken more than half a second from any odometry. At the end it reports how many these were,
// and how far the robot drove meanwhile. Commands have no effect.
class BagDevice final : public RobotDevice {
 public:
  // Reads all odometry, the times of the pictures, and the first picture. Errors list the existing
  // topics.
  [[nodiscard]] static Result<std::unique_ptr<BagDevice>> Open(const BagRun& run);
  ~BagDevice() override;

  [[nodiscard]] Result<std::optional<Observation>> Next() override;
  [[nodiscard]] Result<void> Drive(const motion::VelocityCommand&) override { return {}; }
  [[nodiscard]] std::vector<std::string> TakeNews() override;
  [[nodiscard]] std::string camera() const override;
  [[nodiscard]] std::optional<double> drive_progress() const override;

  // Returns the topics that are read, for people.
  [[nodiscard]] std::string sources() const;

 private:
  struct State;
  explicit BagDevice(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::agent
