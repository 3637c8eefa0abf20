#include "services/vision/src/pattern_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "services/vision/src/frame.h"

namespace trailcast::vision {
namespace {

// A smaller change of scale needs no resizing, because the patches tolerate it.
constexpr double kScaleWorthResizing = 0.06;
// A camera that sees less detail than the scout's blurs the patterns, by its own pixels, in which a
// pattern is smaller.
constexpr double kPixelSigma = 0.4;
constexpr double kLeastBlur_px = 0.3;
constexpr double kLevels = 15.0;  // of a stored pattern

struct Peak {
  cv::Point2f at;  // pixel coordinates of the searched picture
  double correlation = 0.0;
};

// Returns the vertex of the parabola through three equidistant samples, as an offset from the
// middle one.
float ParabolaVertex(float left, float middle, float right) {
  const float curvature = left - 2.0F * middle + right;
  return std::abs(curvature) < 1e-6F ? 0.0F
                                     : std::clamp(0.5F * (left - right) / curvature, -0.5F, 0.5F);
}

// Returns the stored pattern as a camera of this magnification sees it.
cv::Mat PatternOf(const route::Patch& patch, double magnification) {
  cv::Mat stored(route::kPatchSize, route::kPatchSize, CV_8UC1,
                 const_cast<std::uint8_t*>(patch.data()));
  const double blur_px =
      kPixelSigma * std::sqrt(std::max(0.0, 1.0 / (magnification * magnification) - 1.0));
  if (blur_px < kLeastBlur_px) return stored;
  cv::Mat blurred;
  stored.convertTo(blurred, CV_8U, 255.0 / kLevels);
  cv::GaussianBlur(blurred, blurred, {}, blur_px, blur_px, cv::BORDER_REPLICATE);
  return blurred;
}

// Returns the best place of the pattern in the window of `picture` around `expected`.
std::optional<Peak> BestPlace(const cv::Mat& picture, const cv::Mat& pattern, cv::Point2f expected,
                              cv::Point2f radius) {
  const int half = route::kPatchSize / 2;
  const cv::Rect window = cv::Rect(cv::Point(cvRound(expected.x - radius.x) - half,
                                             cvRound(expected.y - radius.y) - half),
                                   cv::Point(cvRound(expected.x + radius.x) + half + 1,
                                             cvRound(expected.y + radius.y) + half + 1)) &
                          cv::Rect({0, 0}, picture.size());
  if (window.width < route::kPatchSize || window.height < route::kPatchSize) return std::nullopt;
  cv::Mat score;
  cv::matchTemplate(picture(window), pattern, score, cv::TM_CCOEFF_NORMED);
  Peak peak;
  cv::Point best;
  cv::minMaxLoc(score, nullptr, &peak.correlation, nullptr, &best);
  peak.at = cv::Point2f(static_cast<float>(window.x + best.x + half),
                        static_cast<float>(window.y + best.y + half));
  if (best.x > 0 && best.x + 1 < score.cols) {
    peak.at.x += ParabolaVertex(score.at<float>(best.y, best.x - 1), score.at<float>(best),
                                score.at<float>(best.y, best.x + 1));
  }
  if (best.y > 0 && best.y + 1 < score.rows) {
    peak.at.y += ParabolaVertex(score.at<float>(best.y - 1, best.x), score.at<float>(best),
                                score.at<float>(best.y + 1, best.x));
  }
  return peak;
}

// Returns the frame at the scout's magnification.
cv::Mat AtScoutScale(const cv::Mat& frame, double scale) {
  if (std::abs(scale - 1.0) < kScaleWorthResizing) return frame;
  cv::Mat resized;
  cv::resize(frame, resized, {}, 1.0 / scale, 1.0 / scale,
             scale > 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

}  // namespace

PatternMatches SeekPatterns(const cv::Mat& frame, std::span<const route::Feature> sought,
                            std::span<const route::TrackedFeature> expected, double magnification,
                            const SearchRadius& radius, double min_correlation) {
  const cv::Mat picture = AtScoutScale(frame, magnification);
  PatternMatches matches;
  matches.scale = static_cast<double>(frame.cols) / picture.cols;  // exact, after rounding
  const cv::Point2f centre = Centre(picture.size());
  const cv::Point2f reach(static_cast<float>(radius.u_px), static_cast<float>(radius.v_px));
  const cv::Rect2f whole_patterns(0.5F * route::kPatchSize, 0.5F * route::kPatchSize,
                                  static_cast<float>(picture.cols - route::kPatchSize),
                                  static_cast<float>(picture.rows - route::kPatchSize));
  for (const route::TrackedFeature& feature : expected) {
    const double u = feature.u_px / matches.scale;
    const double v = feature.v_px / matches.scale;
    const cv::Point2f place(centre.x + static_cast<float>(u), centre.y + static_cast<float>(v));
    matches.in_picture += whole_patterns.contains(place) ? 1 : 0;
    const cv::Mat pattern =
        PatternOf(sought[static_cast<std::size_t>(feature.id)].patch, magnification);
    const auto peak = BestPlace(picture, pattern, place, reach);
    if (!peak || peak->correlation < min_correlation) continue;
    matches.pairs.push_back({u, v, peak->at.x - centre.x, peak->at.y - centre.y});
    matches.ids.push_back(feature.id);
  }
  return matches;
}

}  // namespace trailcast::vision
