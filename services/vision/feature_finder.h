#pragma once

#include <span>
#include <vector>

#include "services/image/image.h"
#include "services/route/tracked_feature.h"
#include "services/vision/view_fit.h"

namespace trailcast::vision {

struct FeatureFinderOptions {
  // Near search: correlation of the stored pattern around the place where it is expected.
  double search_u_px = 28.0;  // scout pixels to either side; 5 cm and 3 degrees off move a near
  double search_v_px = 14.0;  // feature so far at 320x240
  double min_correlation = 0.70;
  // What the found ones must agree on, scout pixels (see ViewFitOptions).
  double agree_u_px = 16.0;
  double agree_v_px = 5.0;
  // Wide search, over the whole frame and all these magnifications (camera at hand / scout's).
  double min_magnification = 0.35;
  double max_magnification = 2.9;
  int wide_corners = 350;       // looked at for each magnification
  int max_hamming_bits = 64;    // of 256
  double hamming_ratio = 0.85;  // best to second best
  int min_wide_inliers = 7;
};

struct FindResult {
  std::vector<route::TrackedFeature> features;  // id: position in the list that was sought
  ViewFit fit;                                  // of those
};

// Finds a segment's stored features in a frame of whatever camera. Deterministic, stateless.
class FeatureFinder {
 public:
  explicit FeatureFinder(const FeatureFinderOptions& options = {}) : options_(options) {}

  // Where they are expected: at fraction `s` of their taught tracks, seen through `expected`.
  [[nodiscard]] FindResult FindNear(const image::GrayImage& frame,
                                    std::span<const route::Feature> sought, double s,
                                    const ViewFit& expected) const;

  // Anywhere and at any magnification, by descriptors. No features in the result: not found. What
  // it finds is coarse: follow it with FindNear.
  [[nodiscard]] FindResult FindWide(const image::GrayImage& frame,
                                    std::span<const route::Feature> sought, double s) const;

 private:
  FeatureFinderOptions options_;
};

}  // namespace trailcast::vision
