#include <array>
#include <opencv2/imgproc.hpp>

#include "services/vision/src/frame.h"

namespace trailcast::vision {
namespace {

constexpr int kDarkLevel = 28;             // a surround is black except for noise and compression
constexpr int kCornersNeeded = 3;          // of the image's four, because a dark object covers one
                                           // or two
constexpr double kLargestDarkShare = 0.6;  // a picture with more darkness shows a dark scene, not a
                                           // lens
constexpr double kRimShareOfWidth = 0.06;  // features on the circle's rim belong to the lens

}  // namespace

cv::Mat DarkPixels(const cv::Mat& frame) {
  cv::Mat dark;
  cv::blur(frame, dark, cv::Size(5, 5));
  cv::threshold(dark, dark, kDarkLevel, 1, cv::THRESH_BINARY_INV);
  return dark;
}

std::optional<cv::Mat> DarkSurround(const cv::Mat& frame) {
  cv::Mat dark = DarkPixels(frame);
  const std::array<cv::Point, 4> corners{cv::Point(0, 0), cv::Point(frame.cols - 1, 0),
                                         cv::Point(0, frame.rows - 1),
                                         cv::Point(frame.cols - 1, frame.rows - 1)};
  int dark_corners = 0;
  for (const cv::Point& corner : corners) {
    if (dark.at<std::uint8_t>(corner) == 0) continue;
    ++dark_corners;
    if (dark.at<std::uint8_t>(corner) == 1) cv::floodFill(dark, corner, cv::Scalar(255));
  }
  cv::Mat surround = dark == 255;
  const double share = cv::countNonZero(surround) / static_cast<double>(frame.total());
  if (dark_corners < kCornersNeeded || share > kLargestDarkShare) return std::nullopt;
  return surround;
}

cv::Mat FieldOfView(const cv::Mat& frame) {
  std::optional<cv::Mat> surround = DarkSurround(frame);
  if (!surround) return {frame.size(), CV_8UC1, cv::Scalar(255)};
  const int rim_px = std::max(2, static_cast<int>(kRimShareOfWidth * frame.cols));
  cv::dilate(*surround, *surround,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * rim_px + 1, 2 * rim_px + 1}));
  return *surround == 0;
}

}  // namespace trailcast::vision
