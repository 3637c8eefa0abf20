#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "services/route/track.h"
#include "services/vision/appearance.h"
#include "services/vision/feature_finder.h"
#include "services/vision/frame.h"

namespace trailcast::vision {
namespace {

constexpr double kMagnificationStep = 1.25;  // ORB bears about half of this either way

struct Candidate {
  int index = 0;  // of the sought feature
  ViewPair pair;  // in pixels of the searched picture
};

std::vector<cv::KeyPoint> Corners(const cv::Mat& picture, int most) {
  std::vector<cv::Point2f> points;
  cv::goodFeaturesToTrack(picture, points, most, 0.005, 5.0, FieldOfView(picture), 5);
  std::vector<cv::KeyPoint> corners;
  corners.reserve(points.size());
  for (const cv::Point2f& point : points) corners.push_back(UprightKeyPoint(point));
  return corners;
}

}  // namespace

FindResult FeatureFinder::FindWide(const image::GrayImage& frame,
                                   std::span<const route::Feature> sought, double s) const {
  FindResult best;
  for (double magnification = options_.min_magnification;
       magnification <= options_.max_magnification; magnification *= kMagnificationStep) {
    cv::Mat picture;
    cv::resize(View(frame), picture, {}, 1.0 / magnification, 1.0 / magnification,
               magnification > 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
    const double scale = static_cast<double>(frame.width) / picture.cols;
    const cv::Point2f centre = Centre(picture.size());
    std::vector<cv::KeyPoint> corners = Corners(picture, options_.wide_corners);
    if (corners.size() < 2) continue;
    const cv::Mat descriptors = DescribeUpright(picture, corners);
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < sought.size() && descriptors.rows >= 2; ++i) {
      double nearest = 257;
      double second = 257;
      int row_of_nearest = 0;
      const cv::Mat wanted(1, static_cast<int>(sought[i].descriptor.size()), CV_8UC1,
                           const_cast<std::uint8_t*>(sought[i].descriptor.data()));
      for (int row = 0; row < descriptors.rows; ++row) {
        const double bits = cv::norm(descriptors.row(row), wanted, cv::NORM_HAMMING);
        if (bits < nearest) {
          second = nearest;
          nearest = bits;
          row_of_nearest = row;
        } else {
          second = std::min(second, bits);
        }
      }
      if (nearest > options_.max_hamming_bits || nearest > options_.hamming_ratio * second)
        continue;
      const route::TrackKnot taught = route::TaughtPlace(sought[i], s);
      const cv::Point2f at = corners[static_cast<std::size_t>(row_of_nearest)].pt - centre;
      candidates.push_back({static_cast<int>(i), {taught.u_px, taught.v_px, at.x, at.y}});
    }
    std::vector<ViewPair> pairs;
    for (const Candidate& candidate : candidates) pairs.push_back(candidate.pair);
    ViewFitOptions agree;
    agree.min_scale = 1.0 / kMagnificationStep;
    agree.max_scale = kMagnificationStep;
    agree.tolerance_u_px = options_.agree_u_px;
    agree.tolerance_v_px = options_.agree_v_px;
    const ViewFitResult agreed = FitView(pairs, agree);
    if (agreed.inliers < options_.min_wide_inliers ||
        agreed.inliers <= static_cast<int>(best.features.size())) {
      continue;
    }
    best.features.clear();
    best.fit = {agreed.fit.scale * scale, agreed.fit.du_px * scale, agreed.fit.dv_px * scale};
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!agreed.inlier[i]) continue;
      best.features.push_back({candidates[i].index, pairs[i].u_px * scale, pairs[i].v_px * scale});
    }
  }
  return best;
}

}  // namespace trailcast::vision
