#pragma once

#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"

namespace trailcast::agent {

// A time: so many seconds after the robot's first command to drive, and a duration.
struct Spell {
  double after_s = 0.0;
  double for_s = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contains(double since_s) const {
    return since_s >= after_s && since_s - after_s < for_s;
  }
};

// Parses "12.5", or "4+0.3" for one that is over after 0.3 s.
[[nodiscard]] std::optional<Spell> ParseSpell(std::string_view text);

// A fault of a virtual robot, so many seconds after its first command to drive, and its duration.
// An event at one moment (a frame set to zero, a clock set back) has no end.
struct RobotFault {
  enum class Kind {
    kCameraFreezes,
    kCameraStops,
    kCameraClockBack,  // by five seconds
    kCameraStampsStand,
    kOdometryStops,
    kOdometryRestarts,   // it begins again at zero
    kOdometryJumps,      // by two metres and half a radian
    kOdometryClockBack,  // by five seconds
    kBaseStops,
    kWheelSlips,  // the left one, with a third of its grip
  };
  Kind kind = Kind::kCameraFreezes;
  Spell spell;
};

// Parses "camera-freezes@12.5", or "base-stops@4+0.3" for one that is over after 0.3 s.
// kInvalidArgument names all faults.
[[nodiscard]] Result<RobotFault> ParseRobotFault(const std::string& text);
[[nodiscard]] std::string RobotFaultNames();

// Tells which of a robot's faults are present. It reads no clock itself.
class RobotFaults {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit RobotFaults(const std::vector<RobotFault>& faults);

  // Notes the robot's first command to drive.
  void DroveAt(Time now);
  // Returns the names of those that have begun since the last call.
  [[nodiscard]] std::vector<std::string> Advance(Time now);

  [[nodiscard]] bool active(RobotFault::Kind kind) const;
  // It is nothing before the first command to drive.
  [[nodiscard]] std::optional<double> SecondsDriven(Time now) const;
  // Returns when the first fault began.
  [[nodiscard]] std::optional<Time> first_began_at() const { return first_began_at_; }

 private:
  struct Entry {
    RobotFault fault;
    bool begun = false;
    bool active = false;
  };
  std::vector<Entry> entries_;
  std::optional<Time> drove_at_;
  std::optional<Time> first_began_at_;
};

}  // namespace trailcast::agent
