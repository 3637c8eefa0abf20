#pragma once

#include <cstdint>
#include <vector>

namespace trailcast::vision {

// How a picture from one camera maps onto one from another camera looking the same way: scale and
// shift of pixel coordinates counted from the image centres. Nothing about lenses is known.
struct ViewFit {
  double scale = 1.0;  // pixels of the camera at hand per pixel of the scout's
  double du_px = 0.0;  // pixels of the camera at hand
  double dv_px = 0.0;

  [[nodiscard]] double MapU(double scout_u_px) const { return scale * scout_u_px + du_px; }
  [[nodiscard]] double MapV(double scout_v_px) const { return scale * scout_v_px + dv_px; }
};

// One feature seen by both, each from its own image centre.
struct ViewPair {
  double scout_u_px = 0.0;
  double scout_v_px = 0.0;
  double u_px = 0.0;
  double v_px = 0.0;
};

struct ViewFitOptions {
  double min_scale = 0.25;
  double max_scale = 4.0;
  // How far off a pair may be and still belong: sideways displacement of the robot moves near
  // features along u and none along v.
  double tolerance_u_px = 10.0;
  double tolerance_v_px = 5.0;
  int draws = 200;
};

struct ViewFitResult {
  ViewFit fit;
  std::vector<bool> inlier;  // one for each pair
  int inliers = 0;           // 0: no fit found, `fit` is then the identity
};

// RANSAC over pairs of pairs, then least squares over the inliers, as far as the scale stays within
// bounds. Repeatable for equal input.
[[nodiscard]] ViewFitResult FitView(const std::vector<ViewPair>& pairs,
                                    const ViewFitOptions& options = {});

}  // namespace trailcast::vision
