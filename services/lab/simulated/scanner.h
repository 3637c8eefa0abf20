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

// Something round that stands in the world for a while, for scanner and range sensors alone:
// cameras do not see it, and a base drives through it.
struct Pillar {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // world frame, metres
  double radius_m = 0.2;
  Spell spell;
};

// From "3,1.5,0.2@0+10": where, how wide, and when as for robots' faults.
[[nodiscard]] Result<Pillar> ParsePillar(const std::string& text);

// What a scanner sees all round: the world's surfaces, who is on `stage`, and `pillars`. Frame of
// the scanner: x ahead, y left.
[[nodiscard]] motion::Scan LookAround(const sim::World& world, const sim::Stage& stage,
                                      const Eigen::Isometry3d& world_from_scanner,
                                      const std::vector<Pillar>& pillars);

// What a sonar sees, straight ahead of it along x, within its cone in the level plane.
[[nodiscard]] motion::ConeRange LookAhead(const sim::World& world, const sim::Stage& stage,
                                          const Eigen::Isometry3d& world_from_sensor,
                                          const std::vector<Pillar>& pillars);

}  // namespace trailcast::agent
