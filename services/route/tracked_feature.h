#pragma once

#include "services/route/route.h"

namespace trailcast::route {

// This is where a feature is in the current image, in pixels of the camera that took it, from its
// image centre, u to the right, v down. While teaching, `id` counts detections; while replaying, it
// is the feature's position in Segment::features.
struct TrackedFeature {
  int id = 0;
  double u_px = 0.0;
  double v_px = 0.0;
};

// This is a feature as detected, with its appearance.
struct DescribedFeature {
  TrackedFeature at;
  Patch patch{};
};

}  // namespace trailcast::route
