#include "services/photos/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace trailcast::photos {
namespace {

// Pictures are compared at this width at most: what people can see in them is larger.
constexpr int kMostWidth_px = 960;
constexpr int kFeatures = 1500;
constexpr float kDistinct = 0.8F;  // of the best match's distance to the second best's
constexpr double kAgrees_px = 3.0;
// So many matches at random do not agree.
constexpr int kLeastAgreeing = 25;
constexpr double kLeastShare = 0.25;
constexpr double kLeastOverlap = 0.5;
// A robot that passes a spot again stands close to where it stood.
constexpr double kLeastScale = 0.6;
constexpr double kMostScale = 1.7;
// What is near moves against what is far when the camera is beside its earlier place.
constexpr int kSlack_px = 4;
constexpr double kLeastContrast = 25.0;
constexpr double kNoises = 5.0;  // times the median difference
constexpr double kLeastArea = 1.0 / 1500.0;
constexpr double kMostChanged = 0.4;

cv::Mat ViewOf(const image::GrayImage& picture) {
  return {picture.height, picture.width, CV_8UC1, const_cast<std::uint8_t*>(picture.pixels.data())};
}

double ScaleOf(const image::GrayImage& picture) {
  return std::min(1.0, static_cast<double>(kMostWidth_px) / picture.width);
}

cv::Mat Reduced(const image::GrayImage& picture) {
  const double scale = ScaleOf(picture);
  cv::Mat reduced;
  if (scale < 1.0) {
    cv::resize(ViewOf(picture), reduced, {}, scale, scale, cv::INTER_AREA);
  } else {
    reduced = ViewOf(picture).clone();
  }
  return reduced;
}

struct Matched {
  std::vector<cv::Point2f> earlier;
  std::vector<cv::Point2f> later;
};

Matched Match(const cv::Mat& earlier, const cv::Mat& later) {
  const auto orb = cv::ORB::create(kFeatures);
  std::vector<cv::KeyPoint> before;
  std::vector<cv::KeyPoint> now;
  cv::Mat described_before;
  cv::Mat described_now;
  orb->detectAndCompute(earlier, {}, before, described_before);
  orb->detectAndCompute(later, {}, now, described_now);
  Matched matched;
  if (before.size() < 2 || now.size() < 2) return matched;
  std::vector<std::vector<cv::DMatch>> nearest;
  cv::BFMatcher(cv::NORM_HAMMING).knnMatch(described_before, described_now, nearest, 2);
  for (const auto& two : nearest) {
    if (two.size() < 2 || two[0].distance > kDistinct * two[1].distance) continue;
    matched.earlier.push_back(before[static_cast<std::size_t>(two[0].queryIdx)].pt);
    matched.later.push_back(now[static_cast<std::size_t>(two[0].trainIdx)].pt);
  }
  return matched;
}

tl::unexpected<Error> DoNotAlign(const std::string& why) {
  return Fail(ErrorCode::kConflict,
              "the two photos do not align: {}; look at them side by side instead", why);
}

// Says whether it only moves, turns, scales and tilts a picture a little.
bool IsPlausible(const cv::Mat& homography, const cv::Size& size) {
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  const std::vector<cv::Point2f> corners{{0, 0}, {width, 0}, {width, height}, {0, height}};
  std::vector<cv::Point2f> moved;
  cv::perspectiveTransform(corners, moved, homography);
  if (!cv::isContourConvex(moved)) return false;
  const double scale = std::sqrt(cv::contourArea(moved) / (width * height));
  return scale >= kLeastScale && scale <= kMostScale;
}

// Fits the light of the earlier picture to the later one's, by gain and offset, with what has
// changed left out.
cv::Mat InLightOf(const cv::Mat& later, const cv::Mat& earlier, const cv::Mat& valid) {
  constexpr int kRounds = 4;
  constexpr double kKept = 2.0;  // times the standard deviation
  cv::Mat from;
  cv::Mat to;
  earlier.convertTo(from, CV_32F);
  later.convertTo(to, CV_32F);
  cv::Mat counts = valid.clone();
  cv::Mat fitted;
  for (int round = 0; round < kRounds; ++round) {
    const double mean_from = cv::mean(from, counts)[0];
    const double mean_to = cv::mean(to, counts)[0];
    const cv::Mat deviation = from - mean_from;
    const double variance = cv::mean(deviation.mul(deviation), counts)[0];
    const double together = cv::mean(deviation.mul(to - mean_to), counts)[0];
    const double gain = variance > 1.0 ? std::clamp(together / variance, 0.3, 3.0) : 1.0;
    fitted = deviation * gain + mean_to;
    cv::Mat off = cv::abs(to - fitted);
    const double sigma = std::sqrt(cv::mean(off.mul(off), counts)[0]);
    counts = valid & (off <= std::max(1.0, kKept * sigma));
  }
  cv::Mat in_light;
  fitted.convertTo(in_light, CV_8U);
  return in_light;
}

// Returns by how much each pixel of `one` lies outside what `other` has around that place.
cv::Mat Beyond(const cv::Mat& one, const cv::Mat& other) {
  const cv::Mat around =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kSlack_px + 1, 2 * kSlack_px + 1});
  cv::Mat most;
  cv::Mat least;
  cv::dilate(other, most, around);
  cv::erode(other, least, around);
  cv::Mat above;
  cv::Mat below;
  cv::subtract(one, most, above);
  cv::subtract(least, one, below);
  return cv::max(above, below);
}

double MedianOf(const cv::Mat& values, const cv::Mat& valid) {
  std::vector<std::uint8_t> all;
  for (int y = 0; y < values.rows; ++y) {
    for (int x = 0; x < values.cols; ++x) {
      if (valid.at<std::uint8_t>(y, x) != 0) all.push_back(values.at<std::uint8_t>(y, x));
    }
  }
  if (all.empty()) return 0.0;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

// Returns the blobs of what has changed, in pixels of the reduced picture.
std::vector<ChangedRegion> Blobs(const cv::Mat& difference, const cv::Mat& changed) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centres;
  const int count = cv::connectedComponentsWithStats(changed, labels, stats, centres);
  std::vector<ChangedRegion> regions;
  for (int i = 1; i < count; ++i) {
    const int area = stats.at<int>(i, cv::CC_STAT_AREA);
    if (area < kLeastArea * static_cast<double>(changed.total())) continue;
    regions.push_back({.x = stats.at<int>(i, cv::CC_STAT_LEFT),
                       .y = stats.at<int>(i, cv::CC_STAT_TOP),
                       .width = stats.at<int>(i, cv::CC_STAT_WIDTH),
                       .height = stats.at<int>(i, cv::CC_STAT_HEIGHT),
                       .contrast = cv::mean(difference, labels == i)[0]});
  }
  const auto strikes = [](const ChangedRegion& region) {
    return region.contrast * std::sqrt(static_cast<double>(region.width) * region.height);
  };
  std::sort(regions.begin(), regions.end(), [&](const ChangedRegion& a, const ChangedRegion& b) {
    return strikes(a) > strikes(b);
  });
  if (regions.size() > kMostRegions) regions.resize(kMostRegions);
  return regions;
}

cv::Mat Smoothed(const cv::Mat& picture) {
  constexpr int kBlur_px = 5;
  cv::Mat smooth;
  cv::GaussianBlur(picture, smooth, {kBlur_px, kBlur_px}, 0.0);
  return smooth;
}

}  // namespace

Result<Comparison> Compare(const image::GrayImage& earlier, const image::GrayImage& later) {
  if (earlier.empty() || later.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "one of the two photos has no pixels");
  }
  const cv::Mat before = Reduced(earlier);
  const cv::Mat now = Reduced(later);
  const Matched matched = Match(before, now);
  const auto pairs = static_cast<int>(matched.earlier.size());
  if (pairs < kLeastAgreeing) {
    return DoNotAlign(fmt::format("{} of their features resemble each other, {} are needed", pairs,
                                  kLeastAgreeing));
  }
  cv::Mat agree;
  const cv::Mat homography =
      cv::findHomography(matched.earlier, matched.later, cv::RANSAC, kAgrees_px, agree);
  const int agreeing = homography.empty() ? 0 : cv::countNonZero(agree);
  if (agreeing < kLeastAgreeing || agreeing < kLeastShare * pairs) {
    return DoNotAlign(
        fmt::format("of {} features that resemble each other, {} agree on how the "
                    "camera has moved",
                    pairs, agreeing));
  }
  if (!IsPlausible(homography, before.size())) {
    return DoNotAlign("they were taken from too different places");
  }
  cv::Mat aligned;
  cv::Mat valid;
  cv::warpPerspective(before, aligned, homography, now.size());
  cv::warpPerspective(cv::Mat(before.size(), CV_8UC1, cv::Scalar(255)), valid, homography,
                      now.size(), cv::INTER_NEAREST);
  cv::erode(valid, valid, cv::Mat(), {-1, -1}, kSlack_px + 2, cv::BORDER_CONSTANT, cv::Scalar(0));
  const double overlap = cv::countNonZero(valid) / static_cast<double>(now.total());
  if (overlap < kLeastOverlap) {
    return DoNotAlign(fmt::format("they have {:.0f} % of the picture in common", 100.0 * overlap));
  }
  const cv::Mat smooth = Smoothed(now);
  const cv::Mat lit = InLightOf(smooth, Smoothed(aligned), valid);
  cv::Mat difference = cv::max(Beyond(smooth, lit), Beyond(lit, smooth));
  difference.setTo(0, ~valid);
  const double median = MedianOf(difference, valid);
  cv::Mat changed = difference > std::max(kLeastContrast, kNoises * median);
  cv::morphologyEx(changed, changed, cv::MORPH_OPEN, cv::Mat());
  constexpr int kJoin_px = 9;
  cv::morphologyEx(changed, changed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {kJoin_px, kJoin_px}));
  const double share = cv::countNonZero(changed) / (overlap * static_cast<double>(now.total()));
  if (share > kMostChanged) {
    return DoNotAlign(
        fmt::format("{:.0f} % of what they have in common looks otherwise, as by "
                    "another light",
                    100.0 * share));
  }
  Comparison comparison{.overlap = overlap, .agreeing = agreeing};
  comparison.changes = Blobs(difference, changed);
  const double scale = ScaleOf(later);
  for (ChangedRegion& region : comparison.changes) {
    const auto full = [&](int px) { return static_cast<int>(std::lround(px / scale)); };
    region.x = full(region.x);
    region.y = full(region.y);
    region.width = std::min(full(region.width), later.width - region.x);
    region.height = std::min(full(region.height), later.height - region.y);
  }
  // For people at full size, with the earlier photo's own light.
  const double earlier_scale = ScaleOf(earlier);
  const cv::Mat to_reduced =
      (cv::Mat_<double>(3, 3) << earlier_scale, 0, 0, 0, earlier_scale, 0, 0, 0, 1);
  const cv::Mat to_full = (cv::Mat_<double>(3, 3) << 1 / scale, 0, 0, 0, 1 / scale, 0, 0, 0, 1);
  comparison.earlier = {
      later.width, later.height,
      std::vector<std::uint8_t>(static_cast<std::size_t>(later.width) * later.height)};
  cv::Mat full = ViewOf(comparison.earlier);
  cv::warpPerspective(ViewOf(earlier), full, to_full * homography * to_reduced, full.size());
  return comparison;
}

}  // namespace trailcast::photos
