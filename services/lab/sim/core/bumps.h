#pragma once

#include <Eigen/Core>
#include <vector>

namespace trailcast::sim {

// Rough ground within a circle of the world's plane, with bumps that wheels feel and cameras do not
// see.
struct RoughPatch {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // metres
  double radius_m = 1.0;
  double height_m = 0.01;  // RMS; 0.15 to 0.6 m long, flatter towards the circle's edge
};

// Returns how much higher the ground is there. The same place always gives the same height.
[[nodiscard]] double BumpAt(const std::vector<RoughPatch>& patches, const Eigen::Vector2d& place);

}  // namespace trailcast::sim
