#include "services/vision/src/appearance.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace trailcast::vision {
namespace {

constexpr float kMiddleLevel = 8.0F;
constexpr float kLevelsPerSigma = 3.0F;  // the 16 levels span +-2.5 standard deviations

}  // namespace

std::optional<route::Patch> CutPatch(const cv::Mat& frame, cv::Point2f centre) {
  constexpr float kHalf = 0.5F * route::kPatchSize;
  if (centre.x < kHalf || centre.y < kHalf ||
      centre.x > static_cast<float>(frame.cols - 1) - kHalf ||
      centre.y > static_cast<float>(frame.rows - 1) - kHalf) {
    return std::nullopt;
  }
  cv::Mat grey;
  cv::getRectSubPix(frame, {route::kPatchSize, route::kPatchSize}, centre, grey, CV_32F);
  cv::Scalar mean;
  cv::Scalar sigma;
  cv::meanStdDev(grey, mean, sigma);
  const float scale = kLevelsPerSigma / std::max(1.0F, static_cast<float>(sigma[0]));
  route::Patch patch{};
  std::transform(grey.begin<float>(), grey.end<float>(), patch.begin(), [&](float value) {
    const float level = kMiddleLevel + scale * (value - static_cast<float>(mean[0]));
    return static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 15L));
  });
  return patch;
}

}  // namespace trailcast::vision
