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

// Pictures are compared with longer sides of this length: what people can see in larger ones is
// larger, too, and in smaller ones features at their own size are few.
constexpr int kLonger_px = 640;
constexpr int kLeastShorter_px = 64;
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
// Changes are sought in pictures that are reduced so often again.
constexpr int kCoarser = 2;
// A camera beside its earlier place has near things move against far ones, by up to this in the
// coarser picture, which is searched in steps.
constexpr int kShift_px = 12;
constexpr int kShiftStep_px = 2;
constexpr int kWindow_px = 9;
constexpr double kLeastContrast = 20.0;
constexpr double kSureContrast = 50.0;  // is marked whatever the others are
// This share of all differences is taken for what parallax and light leave, and what is marked
// exceeds it by that factor.
constexpr double kUsual = 0.8;
constexpr double kBeyondUsual = 2.5;
constexpr double kLeastArea = 1.0 / 600.0;
constexpr double kMostChanged = 0.4;

cv::Mat ViewOf(const image::GrayImage& picture) {
  return {picture.height, picture.width, CV_8UC1, const_cast<std::uint8_t*>(picture.pixels.data())};
}

double ScaleOf(const image::GrayImage& picture) {
  return static_cast<double>(kLonger_px) / std::max(picture.width, picture.height);
}

cv::Mat Resized(const image::GrayImage& picture) {
  const double scale = ScaleOf(picture);
  cv::Mat resized;
  cv::resize(ViewOf(picture), resized, {}, scale, scale,
             scale < 1.0 ? cv::INTER_AREA : cv::INTER_CUBIC);
  return resized;
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

// Returns for each pixel of `one` by how much its surroundings differ from the likest ones that
// `other` has nearby.
cv::Mat Unlike(const cv::Mat& one, const cv::Mat& other) {
  cv::Mat around;
  cv::copyMakeBorder(other, around, kShift_px, kShift_px, kShift_px, kShift_px,
                     cv::BORDER_REPLICATE);
  cv::Mat least(one.size(), CV_8UC1, cv::Scalar(255));
  cv::Mat off;
  for (int y = 0; y <= 2 * kShift_px; y += kShiftStep_px) {
    for (int x = 0; x <= 2 * kShift_px; x += kShiftStep_px) {
      cv::absdiff(one, around(cv::Rect(x, y, one.cols, one.rows)), off);
      cv::blur(off, off, {kWindow_px, kWindow_px});
      cv::min(least, off, least);
    }
  }
  return least;
}

// Returns the value that the usual share of all does not exceed.
double UsualOf(const cv::Mat& values, const cv::Mat& valid) {
  std::vector<std::uint8_t> all;
  for (int y = 0; y < values.rows; ++y) {
    for (int x = 0; x < values.cols; ++x) {
      if (valid.at<std::uint8_t>(y, x) != 0) all.push_back(values.at<std::uint8_t>(y, x));
    }
  }
  if (all.empty()) return 0.0;
  const auto usual =
      all.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), usual, all.end());
  return *usual;
}

// Returns the blobs of what has changed, in pixels of the resized picture.
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

}  // namespace

Result<Comparison> Compare(const image::GrayImage& earlier, const image::GrayImage& later) {
  if (earlier.empty() || later.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "one of the two photos has no pixels");
  }
  for (const image::GrayImage* picture : {&earlier, &later}) {
    const int shorter = std::min(picture->width, picture->height);
    if (shorter * ScaleOf(*picture) < kLeastShorter_px) {
      return DoNotAlign(
          fmt::format("one of them is a strip, of {}x{} pixels", picture->width, picture->height));
    }
  }
  const cv::Mat before = Resized(earlier);
  const cv::Mat now = Resized(later);
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
  const cv::Size coarse{now.cols / kCoarser, now.rows / kCoarser};
  cv::resize(valid, valid, coarse, 0.0, 0.0, cv::INTER_NEAREST);
  const double overlap = cv::countNonZero(valid) / static_cast<double>(valid.total());
  if (overlap < kLeastOverlap) {
    return DoNotAlign(fmt::format("they have {:.0f} % of the picture in common", 100.0 * overlap));
  }
  // The edge of the earlier picture is no change.
  cv::erode(valid, valid, cv::Mat(), {-1, -1}, kShift_px, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::Mat later_coarse;
  cv::Mat earlier_coarse;
  cv::resize(now, later_coarse, coarse, 0.0, 0.0, cv::INTER_AREA);
  cv::resize(aligned, earlier_coarse, coarse, 0.0, 0.0, cv::INTER_AREA);
  const cv::Mat lit = InLightOf(later_coarse, earlier_coarse, valid);
  cv::Mat difference = cv::max(Unlike(later_coarse, lit), Unlike(lit, later_coarse));
  difference.setTo(0, ~valid);
  const double usual = UsualOf(difference, valid);
  cv::Mat changed = difference > std::clamp(kBeyondUsual * usual, kLeastContrast, kSureContrast);
  constexpr int kJoin_px = 5;
  cv::morphologyEx(changed, changed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {kJoin_px, kJoin_px}));
  const double share =
      cv::countNonZero(changed) / std::max(1.0, static_cast<double>(cv::countNonZero(valid)));
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
    const auto full = [&](int px) { return static_cast<int>(std::lround(kCoarser * px / scale)); };
    region.x = full(region.x);
    region.y = full(region.y);
    region.width = std::min(full(region.width), later.width - region.x);
    region.height = std::min(full(region.height), later.height - region.y);
  }
  // For people at full size, with the earlier photo's own light.
  const double earlier_scale = ScaleOf(earlier);
  const cv::Mat to_resized =
      (cv::Mat_<double>(3, 3) << earlier_scale, 0, 0, 0, earlier_scale, 0, 0, 0, 1);
  const cv::Mat to_full = (cv::Mat_<double>(3, 3) << 1 / scale, 0, 0, 0, 1 / scale, 0, 0, 0, 1);
  comparison.earlier = {
      later.width, later.height,
      std::vector<std::uint8_t>(static_cast<std::size_t>(later.width) * later.height)};
  cv::Mat full = ViewOf(comparison.earlier);
  cv::warpPerspective(ViewOf(earlier), full, to_full * homography * to_resized, full.size());
  return comparison;
}

}  // namespace trailcast::photos
