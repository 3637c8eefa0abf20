#pragma once

#include "services/replay/path_estimator.h"

namespace trailcast::replay {

struct LaneKeepingOptions {
  // The robot returns to the path along a curve of about this length, without overshoot.
  double convergence_m = 0.5;
  double steepest_rad = 0.5;  // towards the path, from any distance
};

// This steers back onto the taught path and along its bends: omega = kappa v - c1 alpha - c2 e,
// with both gains from one length, and e no larger than the steepest approach asks for. With a
// negative speed the robot drives back along the path; offset and curvature are then given as if it
// was driven forwards.
[[nodiscard]] double LaneKeepingTurnRate(const PathOffset& offset, double curvature_per_m,
                                         double speed_mps, const LaneKeepingOptions& options = {});

}  // namespace trailcast::replay
