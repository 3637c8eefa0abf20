#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/camera.h"
#include "services/lab/simulated/robot_electronics.h"

namespace trailcast::trial {

// A way in which real robots differ from their drawings; a trial draws its amount and its time.
struct Flaw {
  std::string name;
  std::string summary;
};

// The last one, `all`, is all others of this list together.
[[nodiscard]] const std::vector<Flaw>& Flaws();
[[nodiscard]] std::vector<std::string> FlawNames();
// kNotFound lists the existing names. An empty name is a robot without flaws.
[[nodiscard]] Result<void> CheckFlaw(const std::string& name);

// The flaws of one follower, and what its agent is told of them.
struct RobotFlaws {
  sim::CameraModel camera;
  agent::RobotTiming timing;
  std::vector<agent::RobotFault> faults;
  double told_roll_deg = 0.0;
  std::optional<double> told_ahead_m;
};

// Draws the flaw of that name, which must exist, for a follower with `camera`. The drive takes
// about `drive_s`; an event at one moment comes between a quarter and two thirds of that. The same
// seed gives the same robot.
[[nodiscard]] RobotFlaws DrawFlaws(const std::string& name, const sim::CameraModel& camera,
                                   double drive_s, std::uint64_t seed);

}  // namespace trailcast::trial
