#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/motion/scan.h"

namespace trailcast::motion {

// What a scanner sees, scan by scan, without false points: a single return whose neighbours see
// far beyond it (dust, rain, a ray that grazes an edge) is taken for something only when the scan
// before had it, too. A thin pole is seen again and again.
class SteadyPoints {
 public:
  // Those of the next scan, seen from the axle, `ahead_m` of which it looks: x ahead, y left.
  [[nodiscard]] std::vector<Eigen::Vector2d> Next(const Scan& scan, double ahead_m);

 private:
  [[nodiscard]] bool SeenBefore(double angle_rad, double range_m) const;

  Scan before_;
};

}  // namespace trailcast::motion
