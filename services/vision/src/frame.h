#pragma once

// For vision's own sources: OpenCV's view of our pictures.

#include <opencv2/core.hpp>
#include <optional>

#include "services/image/image.h"

namespace trailcast::vision {

// A header over the picture's own pixels; valid as long as `image` is.
[[nodiscard]] inline cv::Mat View(const image::GrayImage& image) {
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())};
}

// Feature coordinates are counted from the image centre: the middle between the outer pixels'
// centres, OpenCV's pixel (0, 0) being the centre of the upper left one.
[[nodiscard]] inline cv::Point2f Centre(cv::Size size) {
  return {0.5F * static_cast<float>(size.width - 1), 0.5F * static_cast<float>(size.height - 1)};
}

// 1 where it is as good as black, else 0.
[[nodiscard]] cv::Mat DarkPixels(const cv::Mat& frame);

// 255 in the black surround that reaches the picture's corners, else 0; nothing where there is
// none.
[[nodiscard]] std::optional<cv::Mat> DarkSurround(const cv::Mat& frame);

// 255 where there is a picture, 0 in the black surround that some lenses leave (a fisheye's circle
// on a larger chip) and close to it. All 255 for a lens without one.
[[nodiscard]] cv::Mat FieldOfView(const cv::Mat& frame);

}  // namespace trailcast::vision
