#include "services/replay/lane_keeping.h"

#include <algorithm>

namespace trailcast::replay {

double LaneKeepingTurnRate(const PathOffset& offset, double curvature_per_m, double speed_mps,
                           const LaneKeepingOptions& options) {
  // This is e'' = -c1 e' - c2 e over distance, critically damped: c1 = 2/L, c2 = 1/L^2. The offset
  // asks for a heading of -e/(2L), which is bounded. The heading is of the robot's front or, in
  // reverse gear, of its back, which is off the path in the other direction.
  const double wanted_rad = std::clamp(-offset.left_m / (2.0 * options.convergence_m),
                                       -options.steepest_rad, options.steepest_rad);
  const double off_rad = speed_mps < 0.0 ? -offset.heading_rad : offset.heading_rad;
  const double turn_per_m = 2.0 / options.convergence_m * (wanted_rad - off_rad);
  return speed_mps * (curvature_per_m + turn_per_m);
}

}  // namespace trailcast::replay
