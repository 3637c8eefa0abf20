#pragma once

#include <vector>

#include "services/replay/feature_verdict.h"
#include "services/replay/follower.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

// One feature for those who look over the robot's shoulder; all in the follower's pixels.
struct FeatureView {
  route::TrackedFeature at;
  route::TrackedFeature expected;   // where the method thinks it should be now
  route::TrackedFeature milestone;  // where it will be at the segment's end
  FeatureVerdict verdict = FeatureVerdict::kInside;
};

// `seen`: of the segment that `follower` is in; `roll_rad`: as its last step found it.
[[nodiscard]] std::vector<FeatureView> ViewFeatures(const Follower& follower,
                                                    const std::vector<route::TrackedFeature>& seen,
                                                    double roll_rad);

}  // namespace trailcast::replay
