#pragma once

#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"

namespace trailcast::agent {

// When: so many seconds after the robot was first told to drive, and for how long.
struct Spell {
  double after_s = 0.0;
  double for_s = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contains(double since_s) const {
    return since_s >= after_s && since_s - after_s < for_s;
  }
};

// From "12.5", or "4+0.3" for one that is over after 0.3 s.
[[nodiscard]] std::optional<Spell> ParseSpell(std::string_view text);

// What goes wrong with a virtual robot, so many seconds after it was first told to drive, and for
// how long. What only happens at one moment (a frame set to zero, a clock set back) has no end.
struct RobotFault {
  enum class Kind {
    kCameraFreezes,
    kCameraStops,
    kCameraClockBack,  // by five seconds
    kCameraStampsStand,
    kOdometryStops,
    kOdometryRestarts,   // begins anew at zero
    kOdometryJumps,      // by two metres and half a radian
    kOdometryClockBack,  // by five seconds
    kBaseStops,
    kWheelSlips,  // the left one, with a third of its grip
  };
  Kind kind = Kind::kCameraFreezes;
  Spell spell;
};

// From "camera-freezes@12.5", or "base-stops@4+0.3" for one that is over after 0.3 s.
// kInvalidArgument names all there are.
[[nodiscard]] Result<RobotFault> ParseRobotFault(const std::string& text);
[[nodiscard]] std::string RobotFaultNames();

// Which of a robot's faults there are by now. Reads no clock itself.
class RobotFaults {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit RobotFaults(const std::vector<RobotFault>& faults);

  // Once the robot has first been told to drive.
  void DroveAt(Time now);
  // Returns the names of those that have begun since the last call.
  [[nodiscard]] std::vector<std::string> Advance(Time now);

  [[nodiscard]] bool active(RobotFault::Kind kind) const;
  // Nothing: it was not yet told to drive.
  [[nodiscard]] std::optional<double> SecondsDriven(Time now) const;
  // Of the first one that began.
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
