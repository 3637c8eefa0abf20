#pragma once

// This header is for vision's own sources: it searches a picture for stored patterns.

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "services/route/route.h"
#include "services/route/tracked_feature.h"
#include "services/vision/feature_finder.h"
#include "services/vision/view_fit.h"

namespace trailcast::vision {

// The best match of each feature sought, if anything resembles it at all.
struct PatternMatches {
  // Each pair has where a feature was expected and where it was found, from the image centre, in
  // pixels of the scout's magnification.
  std::vector<ViewPair> pairs;
  std::vector<int> ids;  // one for each pair, its position in the list that was sought
  double scale = 1.0;    // pixels of the frame per one of those
  int in_picture = 0;    // how many were expected to be in the picture
};

// Searches for features that are `expected` in pixels of `frame` from its centre.
[[nodiscard]] PatternMatches SeekPatterns(const cv::Mat& frame,
                                          std::span<const route::Feature> sought,
                                          std::span<const route::TrackedFeature> expected,
                                          double magnification, const SearchRadius& radius,
                                          double min_correlation);

}  // namespace trailcast::vision
