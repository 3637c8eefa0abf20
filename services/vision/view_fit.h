#pragma once

#include <cstdint>
#include <vector>

namespace trailcast::vision {

// How a picture from one camera maps onto one from another camera that looks the same way: a scale
// and a shift of pixel coordinates, counted from the image centres. It assumes nothing about
// lenses.
struct ViewFit {
  double scale = 1.0;  // this camera's pixels per pixel of the scout's
  double du_px = 0.0;  // this camera's pixels
  double dv_px = 0.0;

  [[nodiscard]] double MapU(double scout_u_px) const { return scale * scout_u_px + du_px; }
  [[nodiscard]] double MapV(double scout_v_px) const { return scale * scout_v_px + dv_px; }
};

// One feature that both cameras see, each counted from its own image centre.
struct ViewPair {
  double scout_u_px = 0.0;
  double scout_v_px = 0.0;
  double u_px = 0.0;
  double v_px = 0.0;
};

struct ViewFitOptions {
  double min_scale = 0.25;
  double max_scale = 4.0;
  // How far off a pair may be and still count as an inlier. A robot's sideways displacement moves
  // near features along u, but not along v.
  double tolerance_u_px = 10.0;
  double tolerance_v_px = 5.0;
  int draws = 200;
};

struct ViewFitResult {
  ViewFit fit;
  std::vector<bool> inlier;  // one for each pair
  int inliers = 0;           // 0 if no fit was found; `fit` is then the identity
};

// Fits by RANSAC over pairs of pairs, then by least squares over the inliers as long as the scale
// stays within bounds. The result is repeatable for equal input.
[[nodiscard]] ViewFitResult FitView(const std::vector<ViewPair>& pairs,
                                    const ViewFitOptions& options = {});

}  // namespace trailcast::vision
