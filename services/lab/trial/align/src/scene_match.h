#pragma once

#include "services/lab/trial/align/src/scene_features.h"

namespace trailcast::trial {

// How far two pictures show one scene.
struct SceneMatch {
  int inliers = 0;  // features that agree on one camera motion between them
  // How much further right these lie in the replay's picture, the median, in its pixels. The taught
  // picture is taken to be scaled to its width, where they differ.
  double median_du_px = 0.0;
};

// Features are paired if each is the other's best and clearly better than the second (Lowe 2004),
// and held against a fundamental matrix, or a homography (MAGSAC, Barath et al. 2019). The same
// features give the same result.
[[nodiscard]] SceneMatch MatchScenes(const SceneFeatures& teach, const SceneFeatures& replay);

}  // namespace trailcast::trial
