#pragma once

#include <span>
#include <vector>

#include "services/route/tracked_feature.h"

namespace trailcast::teach {

// This is how the picture moved as a whole, by features that are in both of two frames.
struct PictureFlow {
  double u_px = 0.0;    // to the right
  double v_px = 0.0;    // down
  double growth = 0.0;  // of the whole picture about the image centre, as a share
};

// This is one feature in two frames.
struct MovedFeature {
  route::TrackedFeature before;
  route::TrackedFeature now;
};

// Returns the features that are in both of two frames. `now` must be `before` without some of its
// features, in the same order, as a tracker returns them.
[[nodiscard]] std::vector<MovedFeature> MovedBetween(std::span<const route::TrackedFeature> before,
                                                     std::span<const route::TrackedFeature> now);

// Returns a shift and a growth of the whole picture by robust least squares (Cauchy weights).
// Driving on makes the picture grow, and turning shifts it. `noise_px` is the noise of a tracked
// feature. Without features there is no flow.
[[nodiscard]] PictureFlow FlowOf(std::span<const MovedFeature> features, double noise_px);

// Returns how far a robot turned, counter-clockwise positive, whose picture of this width moved so.
// It uses the focal length of a usual webcam, as the robot's own is unknown. Another lens makes all
// turns of a drive larger or smaller by one factor.
[[nodiscard]] double TurnOf(const PictureFlow& flow, int width_px);

}  // namespace trailcast::teach
