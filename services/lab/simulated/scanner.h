#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/stage.h"
#include "services/lab/sim/core/world.h"
#include "services/lab/simulated/robot_faults.h"
#include "services/motion/cone_range.h"
#include "services/motion/scan.h"

namespace trailcast::agent {

// A round thing in the world for a while, which only the scanner and the range sensors see. Cameras
// do not see it, and a base drives through it.
struct Pillar {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // world frame, metres
  double radius_m = 0.2;
  Spell spell;
};

// Parses "3,1.5,0.2@0+10": place, radius, and time as for a robot's faults.
[[nodiscard]] Result<Pillar> ParsePillar(const std::string& text);

// Returns a scanner's view all round: the world's surfaces, the actors of `stage`, and `pillars`.
// In its frame, x is ahead and y left.
[[nodiscard]] motion::Scan LookAround(const sim::World& world, const sim::Stage& stage,
                                      const Eigen::Isometry3d& world_from_scanner,
                                      const std::vector<Pillar>& pillars);

// Returns a sonar's view along x, within its cone in the level plane.
[[nodiscard]] motion::ConeRange LookAhead(const sim::World& world, const sim::Stage& stage,
                                          const Eigen::Isometry3d& world_from_sensor,
                                          const std::vector<Pillar>& pillars);

}  // namespace trailcast::agent
