#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "services/vision/feature_finder.h"
#include "services/vision/src/frame.h"
#include "services/vision/src/pattern_search.h"

namespace trailcast::vision {
namespace {

// How one view is turned, scaled and shifted against another, for a robot that rolls, pitches,
// turns or has come nearer: u' = a u - b v + du, v' = b u + a v + dv.
struct Similarity {
  double a = 1.0;
  double b = 0.0;
  double du_px = 0.0;
  double dv_px = 0.0;

  [[nodiscard]] double MapU(double u_px, double v_px) const { return a * u_px - b * v_px + du_px; }
  [[nodiscard]] double MapV(double u_px, double v_px) const { return b * u_px + a * v_px + dv_px; }
  [[nodiscard]] double scale() const { return std::hypot(a, b); }
};

constexpr double kLeastScale = 0.7;
constexpr double kMostScale = 1.4;
constexpr double kLargestRoll_rad = 0.26;  // 15 degrees, as between two robots on slopes that
                                           // differ
constexpr std::size_t kFewestToFitTilted = 4;
// The second search stays near where the first one's fit puts the features.
constexpr double kCloser = 1.5;  // times the tolerance

// Fits by OpenCV's RANSAC and least squares, repeatable for equal input. Returns nothing if the
// pairs do not agree.
std::optional<Similarity> FitSimilarity(const std::vector<ViewPair>& pairs, double tolerance_px) {
  if (pairs.size() < kFewestToFitTilted) return std::nullopt;
  std::vector<cv::Point2d> expected;
  std::vector<cv::Point2d> found;
  for (const ViewPair& pair : pairs) {
    expected.emplace_back(pair.scout_u_px, pair.scout_v_px);
    found.emplace_back(pair.u_px, pair.v_px);
  }
  const cv::Mat fit =
      cv::estimateAffinePartial2D(expected, found, cv::noArray(), cv::RANSAC, tolerance_px);
  if (fit.empty()) return std::nullopt;
  const Similarity similarity{fit.at<double>(0, 0), fit.at<double>(1, 0), fit.at<double>(0, 2),
                              fit.at<double>(1, 2)};
  const bool plausible = similarity.scale() >= kLeastScale && similarity.scale() <= kMostScale &&
                         std::abs(std::atan2(similarity.b, similarity.a)) <= kLargestRoll_rad;
  return plausible ? std::optional(similarity) : std::nullopt;
}

// Returns the features that were found where they were expected.
FindResult Agreeing(const PatternMatches& matches, const FeatureFinderOptions& options) {
  FindResult result;
  for (std::size_t i = 0; i < matches.pairs.size(); ++i) {
    const ViewPair& pair = matches.pairs[i];
    if (std::abs(pair.u_px - pair.scout_u_px) > options.agree_u_px ||
        std::abs(pair.v_px - pair.scout_v_px) > options.agree_v_px) {
      continue;
    }
    result.features.push_back(
        {matches.ids[i], pair.u_px * matches.scale, pair.v_px * matches.scale});
  }
  return result;
}

// Applies the fit; `scale` is the frame's pixels per pixel that the fit is in.
std::vector<route::TrackedFeature> Moved(std::span<const route::TrackedFeature> expected,
                                         const Similarity& fit, double scale) {
  std::vector<route::TrackedFeature> moved;
  moved.reserve(expected.size());
  for (const route::TrackedFeature& at : expected) {
    const double u = at.u_px / scale;
    const double v = at.v_px / scale;
    moved.push_back({at.id, scale * fit.MapU(u, v), scale * fit.MapV(u, v)});
  }
  return moved;
}

}  // namespace

FindResult FeatureFinder::FindTilted(const image::GrayImage& frame,
                                     std::span<const route::Feature> sought,
                                     std::span<const route::TrackedFeature> expected,
                                     double magnification, const SearchRadius& radius) const {
  const cv::Mat picture = View(frame);
  const PatternMatches first =
      SeekPatterns(picture, sought, expected, magnification, radius, options_.min_correlation);
  FindResult result;
  if (const auto fit = FitSimilarity(first.pairs, options_.agree_v_px)) {
    const std::vector<route::TrackedFeature> there = Moved(expected, *fit, first.scale);
    const SearchRadius closer{kCloser * options_.agree_u_px, kCloser * options_.agree_v_px};
    result = Agreeing(
        SeekPatterns(picture, sought, there, magnification, closer, options_.min_correlation),
        options_);
  }
  result.in_picture = first.in_picture;
  result.magnification = magnification;
  return result;
}

}  // namespace trailcast::vision
