#pragma once

// For vision's own sources: stored patterns sought in a picture.

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "services/route/route.h"
#include "services/route/tracked_feature.h"
#include "services/vision/feature_finder.h"
#include "services/vision/view_fit.h"

namespace trailcast::vision {

// What looks most like each of the features sought, if anything looks like it at all.
struct PatternMatches {
  // Where each was expected and where it was found, from the image centre; pixels of the scout's
  // magnification.
  std::vector<ViewPair> pairs;
  std::vector<int> ids;  // one a pair: position in what was sought
  double scale = 1.0;    // pixels of the frame per one of those
  int in_picture = 0;    // how many were expected to be in the picture
};

// `expected` in pixels of `frame` from its centre.
[[nodiscard]] PatternMatches SeekPatterns(const cv::Mat& frame,
                                          std::span<const route::Feature> sought,
                                          std::span<const route::TrackedFeature> expected,
                                          double magnification, const SearchRadius& radius,
                                          double min_correlation);

}  // namespace trailcast::vision
