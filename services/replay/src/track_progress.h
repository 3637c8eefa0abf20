#pragma once

#include <vector>

#include "services/route/tracked_feature.h"

namespace trailcast::replay {

struct TrackProgress {
  double fraction = 0.0;     // of the segment, 0 to kLargestFraction
  double residual_px = 0.0;  // mean distance of the features to their taught places there
};

// Beyond the milestone the taught tracks are drawn out a little, so that passing it can be seen.
inline constexpr double kLargestFraction = 1.2;

// How far along the segment the current picture is: the fraction at which the features' taught
// tracks come closest to where they are now (least mean distance: a few mismatches do no harm).
// Needs no odometry. The paper keeps the first and the last image only; the knots between make this
// possible. `features`: scout's pixels, id is the position in Segment::features; not empty.
[[nodiscard]] TrackProgress EstimateProgress(const route::Segment& segment,
                                             const std::vector<route::TrackedFeature>& features);

}  // namespace trailcast::replay
