#pragma once

#include <span>
#include <vector>

#include "services/route/tracked_feature.h"

namespace trailcast::teach {

// How the picture moved as one, from features that are in both of two frames.
struct PictureFlow {
  double u_px = 0.0;    // to the right
  double v_px = 0.0;    // down
  double growth = 0.0;  // of all that is seen, about the image centre, as a share
};

// One feature in two frames.
struct MovedFeature {
  route::TrackedFeature before;
  route::TrackedFeature now;
};

// Those that are in both of two frames, where `now` is `before` without some, as a tracker has it.
[[nodiscard]] std::vector<MovedFeature> MovedBetween(std::span<const route::TrackedFeature> before,
                                                     std::span<const route::TrackedFeature> now);

// A shift and a growth of the whole picture by robust least squares (Cauchy weights). Driving on
// makes the picture grow, turning shifts it. `noise_px`: of a tracked feature. No features, no
// flow.
[[nodiscard]] PictureFlow FlowOf(std::span<const MovedFeature> features, double noise_px);

// How far a robot turned, counter-clockwise positive, whose picture, so wide, moved so: by the
// focal length of a usual webcam, for nobody knows its own. Another lens makes all turns of a drive
// larger or smaller by one factor.
[[nodiscard]] double TurnOf(const PictureFlow& flow, int width_px);

}  // namespace trailcast::teach
