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

// The robot behind an agent: simulated, recorded or real. Frames come at the device's own
// pace: Next() waits for the next one, in lockstep devices it makes it.
class RobotDevice {
 public:
  virtual ~RobotDevice() = default;
  RobotDevice(const RobotDevice&) = delete;
  RobotDevice& operator=(const RobotDevice&) = delete;

  // The next observation, or nothing when there will be none (a recording's end, a taught drive
  // that is over). An error is final: the camera or the odometry failed.
  [[nodiscard]] virtual Result<std::optional<Observation>> Next() = 0;

  // What the base shall do until told otherwise. Recorded devices note it and do nothing.
  [[nodiscard]] virtual Result<void> Drive(const motion::VelocityCommand& command) = 0;

  // Why a robot had to be stopped.
  struct Halt {
    std::string what;   // one line for people; empty: it may drive again
    bool fault = true;  // something of the robot has failed; otherwise it waits
  };
  // Whom Next tells, from its own thread, that the robot had to be stopped, and that it may drive
  // again (EarForTrouble). Devices that never have to wait for their robot do not call it.
  using Trouble = std::function<void(const Halt& halt)>;
  virtual void OnTrouble(const Trouble& /*tell*/) {}

  // A person drives it from now on, in whatever way, or no longer. Frames then come also while it
  // stands before something, so that it can be driven away from there.
  virtual void ByHand(bool /*begins*/) {}
  // For people who look through the camera of a robot that does not drive, from the thread that
  // calls Next: what it sees now, without waiting. kUnavailable says why there is no picture.
  [[nodiscard]] virtual Result<image::GrayImage> Look() {
    return Fail(ErrorCode::kUnavailable, "its camera is looked through only while it drives");
  }
  // What of a robot has failed, of which nothing is asked now; one line for people, empty: nothing
  // that is known.
  [[nodiscard]] virtual std::string Ailment() { return {}; }

  // Tells people, a line each, what befell its clocks and its odometry since the last call.
  [[nodiscard]] virtual std::vector<std::string> TakeNews() { return {}; }

  // For people: "webcam 320x240", "recorded 160x120".
  [[nodiscard]] virtual std::string camera() const = 0;
  // Share of the drive done, 0..1, where the device knows it (a recording, a scripted scout).
  [[nodiscard]] virtual std::optional<double> drive_progress() const = 0;
  // How full its battery is, where the robot tells. Any thread.
  [[nodiscard]] virtual std::optional<std::uint8_t> battery_percent() const { return std::nullopt; }

 protected:
  RobotDevice() = default;
};

}  // namespace trailcast::agent
