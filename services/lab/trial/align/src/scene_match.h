#pragma once

#include "services/lab/trial/align/src/scene_features.h"

namespace trailcast::trial {

// How well two pictures show one scene.
struct SceneMatch {
  int inliers = 0;  // features that agree on one camera motion between them
  // The median of how much further right these are in the replay's picture, in its pixels. If the
  // widths differ, the taught picture is scaled to it.
  double median_du_px = 0.0;
};

// Pairs features if each is the other's best match and clearly better than the second (Lowe 2004),
// and checks them against a fundamental matrix, or a homography (MAGSAC, Barath et al. 2019). The
// same features give the same result.
[[nodiscard]] SceneMatch MatchScenes(const SceneFeatures& teach, const SceneFeatures& replay);

}  // namespace trailcast::trial
