#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "agent/session/observation.h"
#include "services/base/result.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// The robot behind an agent: simulated, recorded or real. Frames come at the device's own pace:
// Next() waits for the next one, or makes it if the device is in lockstep.
class RobotDevice {
 public:
  virtual ~RobotDevice() = default;
  RobotDevice(const RobotDevice&) = delete;
  RobotDevice& operator=(const RobotDevice&) = delete;

  // Returns the next observation, or nothing if there will be none (at a recording's end, or when a
  // taught drive is over). An error is final: the camera or the odometry failed.
  [[nodiscard]] virtual Result<std::optional<Observation>> Next() = 0;

  // Sets what the base does until the next command. Recorded devices ignore it.
  [[nodiscard]] virtual Result<void> Drive(const motion::VelocityCommand& command) = 0;

  // The reason for which a robot had to be stopped.
  struct Halt {
    std::string what;   // one line for people; empty once it may drive again
    bool fault = true;  // something on the robot has failed; otherwise it waits
  };
  // Called by Next, on its thread, when the robot had to be stopped and when it may drive again
  // (FaultSubscription). Devices that never wait for their robot do not call it.
  using Trouble = std::function<void(const Halt& halt)>;
  virtual void OnTrouble(const Trouble& /*tell*/) {}

  // Tells that a person begins or ceases to drive the robot. Frames then also come while it stands
  // before an obstacle, so that it can be driven away.
  virtual void ByHand(bool /*begins*/) {}
  // Returns the present picture without waiting, for people who look through the camera of a robot
  // that does not drive. The thread that calls Next calls it. kUnavailable says why there is no
  // picture.
  [[nodiscard]] virtual Result<image::GrayImage> Look() {
    return Fail(ErrorCode::kUnavailable, "its camera is looked through only while it drives");
  }
  // Returns a known failure of a robot that is idle, as one line for people, or an empty text.
  [[nodiscard]] virtual std::string Ailment() { return {}; }

  // Returns lines for people about its clocks and its odometry since the last call.
  [[nodiscard]] virtual std::vector<std::string> TakeNews() { return {}; }

  // Returns "webcam 320x240" or "recorded 160x120", for people.
  [[nodiscard]] virtual std::string camera() const = 0;
  // Returns the share of the drive that is done, 0..1, if the device knows it (a recording, a
  // scripted scout).
  [[nodiscard]] virtual std::optional<double> drive_progress() const = 0;
  // Returns the battery's charge if the robot tells it. Any thread may call this.
  [[nodiscard]] virtual std::optional<std::uint8_t> battery_percent() const { return std::nullopt; }

 protected:
  RobotDevice() = default;
};

}  // namespace trailcast::agent
