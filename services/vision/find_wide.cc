#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "services/route/track.h"
#include "services/vision/appearance.h"
#include "services/vision/feature_finder.h"
#include "services/vision/frame.h"

namespace trailcast::vision {
namespace {

constexpr double kMagnificationStep = 1.25;  // ORB bears about half of this either way

std::vector<cv::KeyPoint> Corners(const cv::Mat& picture, int most) {
  std::vector<cv::Point2f> points;
  cv::goodFeaturesToTrack(picture, points, most, 0.005, 5.0, FieldOfView(picture), 5);
  std::vector<cv::KeyPoint> corners;
  corners.reserve(points.size());
  for (const cv::Point2f& point : points) corners.push_back(UprightKeyPoint(point));
  return corners;
}

// The row of the descriptor most like the wanted one, if it is like enough and no other is nearly
// so.
std::optional<int> MostAlike(const cv::Mat& descriptors, const route::Descriptor& wanted,
                             const FeatureFinderOptions& options) {
  const cv::Mat row_wanted(1, static_cast<int>(wanted.size()), CV_8UC1,
                           const_cast<std::uint8_t*>(wanted.data()));
  double nearest = 8.0 * static_cast<double>(wanted.size()) + 1.0;
  double second = nearest;
  int row_of_nearest = 0;
  for (int row = 0; row < descriptors.rows; ++row) {
    const double bits = cv::norm(descriptors.row(row), row_wanted, cv::NORM_HAMMING);
    if (bits < nearest) {
      second = nearest;
      nearest = bits;
      row_of_nearest = row;
    } else {
      second = std::min(second, bits);
    }
  }
  if (nearest > options.max_hamming_bits || nearest > options.hamming_ratio * second) {
    return std::nullopt;
  }
  return row_of_nearest;
}

// The fit with the sought features in a picture of about the scout's magnification.
ViewFitResult FitAtOneMagnification(const cv::Mat& picture, std::span<const route::Feature> sought,
                                    double s, const FeatureFinderOptions& options) {
  std::vector<cv::KeyPoint> corners = Corners(picture, options.wide_corners);
  if (corners.size() < 2) return {};
  const cv::Mat descriptors = DescribeUpright(picture, corners);
  const cv::Point2f centre = Centre(picture.size());
  std::vector<ViewPair> pairs;
  for (const route::Feature& feature : sought) {
    const auto row = MostAlike(descriptors, feature.descriptor, options);
    if (!row) continue;
    const route::TrackKnot taught = route::TaughtPlace(feature, s);
    const cv::Point2f at = corners[static_cast<std::size_t>(*row)].pt - centre;
    pairs.push_back({taught.u_px, taught.v_px, at.x, at.y});
  }
  ViewFitOptions agree;
  agree.min_scale = 1.0 / kMagnificationStep;
  agree.max_scale = kMagnificationStep;
  agree.tolerance_u_px = options.agree_u_px;
  agree.tolerance_v_px = options.agree_v_px;
  return FitView(pairs, agree);
}

}  // namespace

WideResult FeatureFinder::FindWide(const image::GrayImage& frame,
                                   std::span<const route::Feature> sought, double s) const {
  WideResult best;
  for (double magnification = options_.wide_least_magnification;
       magnification <= options_.wide_most_magnification; magnification *= kMagnificationStep) {
    cv::Mat picture;
    cv::resize(View(frame), picture, {}, 1.0 / magnification, 1.0 / magnification,
               magnification > 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
    const double scale = static_cast<double>(frame.width) / picture.cols;
    const ViewFitResult agreed = FitAtOneMagnification(picture, sought, s, options_);
    if (agreed.inliers < std::max(options_.min_wide_inliers, best.matches + 1)) continue;
    best.matches = agreed.inliers;
    best.fit = {agreed.fit.scale * scale, agreed.fit.du_px * scale, agreed.fit.dv_px * scale};
  }
  return best;
}

}  // namespace trailcast::vision
