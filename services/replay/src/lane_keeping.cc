#include "services/replay/lane_keeping.h"

#include <algorithm>

namespace trailcast::replay {

double LaneKeepingTurnRate(const PathOffset& offset, double curvature_per_m, double speed_mps,
                           const LaneKeepingOptions& options) {
  // e'' = -c1 e' - c2 e over distance, critically damped: c1 = 2/L, c2 = 1/L^2. The offset asks for
  // a heading of -e/(2L), which is bounded.
  const double wanted_rad = std::clamp(-offset.left_m / (2.0 * options.convergence_m),
                                       -options.steepest_rad, options.steepest_rad);
  const double turn_per_m = 2.0 / options.convergence_m * (wanted_rad - offset.heading_rad);
  return speed_mps * (curvature_per_m + turn_per_m);
}

}  // namespace trailcast::replay
