#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/camera.h"
#include "services/lab/simulated/robot_electronics.h"

namespace trailcast::trial {

// One way in which real robots are not as drawn, of which a trial draws how much and when.
struct Flaw {
  std::string name;
  std::string summary;
};

// `all` is the last: all others of this list together.
[[nodiscard]] const std::vector<Flaw>& Flaws();
[[nodiscard]] std::vector<std::string> FlawNames();
// kNotFound lists the names there are. An empty name is a robot without any.
[[nodiscard]] Result<void> CheckFlaw(const std::string& name);

// What one follower turned out to be, and what its agent is told of it.
struct RobotFlaws {
  sim::CameraModel camera;
  agent::RobotTiming timing;
  std::vector<agent::RobotFault> faults;
  double told_roll_deg = 0.0;
  std::optional<double> told_ahead_m;
};

// The flaw of that name, drawn for a follower with `camera`. `drive_s` is about how long it will be
// under way: what happens at one moment does so between a quarter and two thirds of that. The same
// seed gives the same robot. The name must be one of those above.
[[nodiscard]] RobotFlaws DrawFlaws(const std::string& name, const sim::CameraModel& camera,
                                   double drive_s, std::uint64_t seed);

}  // namespace trailcast::trial
