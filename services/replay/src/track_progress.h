#pragma once

#include <vector>

#include "services/route/tracked_feature.h"

namespace trailcast::replay {

struct TrackProgress {
  double fraction = 0.0;     // share of the segment, 0 to kLargestFraction
  double residual_px = 0.0;  // mean distance of the features to their taught places there
};

// The taught tracks are extrapolated a little beyond the milestone, so that passing it shows.
inline constexpr double kLargestFraction = 1.2;

// Returns how far along the segment the current picture is: the fraction at which the features'
// taught tracks come closest to where they are now (least mean distance: a few mismatches do no
// harm). It needs no odometry. The paper keeps only the first and the last image; the knots between
// make this possible. `features` are in scout's pixels, with the position in Segment::features as
// id, and not empty.
[[nodiscard]] TrackProgress EstimateProgress(const route::Segment& segment,
                                             const std::vector<route::TrackedFeature>& features);

}  // namespace trailcast::replay
