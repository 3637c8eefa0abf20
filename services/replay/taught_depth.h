#pragma once

#include "services/route/route.h"

namespace trailcast::replay {

// Inverse depth of a landmark, 1/m, and how sure it is.
struct InverseDepth {
  double at_start_per_m = 0.0;  // from the camera's place at the segment's first image
  double sigma_per_m = 0.0;

  // From the camera's place `along_m` into the segment; the landmark comes nearer.
  [[nodiscard]] double At(double along_m) const;
};

// How far away a feature was while it was taught, from its own flow and the odometry's metres: what
// is left of the flow when the turn's part is taken off points away from the image centre and grows
// with nearness, rho = (u u' + v v') / (u^2 + v^2). No calibration: on straight stretches the focal
// length cancels, in turns a usual guess does. `focal_px`: the scout's.
[[nodiscard]] InverseDepth TaughtDepth(const route::Segment& segment, const route::Feature& feature,
                                       double focal_px);

}  // namespace trailcast::replay
