#pragma once

#include "services/route/route.h"

namespace trailcast::route {

// Where a feature is in the current image: pixels of the camera at hand from its image centre, u to
// the right, v down. While teaching `id` counts detections; while replaying it is the feature's
// position in Segment::features.
struct TrackedFeature {
  int id = 0;
  double u_px = 0.0;
  double v_px = 0.0;
};

// A feature as detected, with what it looks like.
struct DescribedFeature {
  TrackedFeature at;
  Patch patch{};
};

}  // namespace trailcast::route
