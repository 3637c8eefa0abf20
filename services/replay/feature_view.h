#pragma once

#include <vector>

#include "services/replay/feature_verdict.h"
#include "services/replay/follower.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

// This is one feature for observers of the robot, in the follower's pixels.
struct FeatureView {
  route::TrackedFeature at;
  route::TrackedFeature expected;   // the method's prediction for now
  route::TrackedFeature milestone;  // its place at the segment's end
  FeatureVerdict verdict = FeatureVerdict::kInside;
};

// `seen` is of the segment that `follower` is in, and `roll_rad` is from its last step.
[[nodiscard]] std::vector<FeatureView> ViewFeatures(const Follower& follower,
                                                    const std::vector<route::TrackedFeature>& seen,
                                                    double roll_rad);

}  // namespace trailcast::replay
