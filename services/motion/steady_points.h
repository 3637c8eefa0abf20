#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/motion/scan.h"

namespace trailcast::motion {

// Filters false points out of a scanner's sweeps. A single return whose neighbours see far beyond
// it (dust, rain, a ray that grazes an edge) counts only if the sweep before had it as well. A thin
// pole is seen again and again, and stays.
class SteadyPoints {
 public:
  // Returns the points of the next sweep, seen from the axle (x ahead, y left), for a scanner that
  // is `ahead_m` ahead of it.
  [[nodiscard]] std::vector<Eigen::Vector2d> Next(const Scan& scan, double ahead_m);

 private:
  [[nodiscard]] bool SeenBefore(double angle_rad, double range_m) const;

  Scan before_;
};

}  // namespace trailcast::motion
