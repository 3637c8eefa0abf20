#pragma once

#include <vector>

#include "services/replay/follower.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

// What the paper's funnel says of one feature, whichever method follows.
enum class FeatureVerdict {
  kInside,     // the funnel lane: content
  kAsksRight,  // for a turn to the right
  kAsksLeft,
  kRejected,  // too far from where it should be: the method does not believe it
};

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
