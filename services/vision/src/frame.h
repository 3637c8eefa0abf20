#pragma once

// This header is for vision's own sources: it shows our pictures to OpenCV.

#include <opencv2/core.hpp>
#include <optional>

#include "services/image/image.h"

namespace trailcast::vision {

// Returns a header over the picture's own pixels, valid as long as `image` is.
[[nodiscard]] inline cv::Mat View(const image::GrayImage& image) {
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())};
}

// Returns the image centre, from which feature coordinates are counted: the middle between the
// outer pixels' centres. OpenCV's pixel (0, 0) is the centre of the upper left one.
[[nodiscard]] inline cv::Point2f Centre(cv::Size size) {
  return {0.5F * static_cast<float>(size.width - 1), 0.5F * static_cast<float>(size.height - 1)};
}

// Returns 1 where the frame is as good as black, else 0.
[[nodiscard]] cv::Mat DarkPixels(const cv::Mat& frame);

// Returns 255 in the black surround that reaches the picture's corners, else 0; nothing if there is
// no such surround.
[[nodiscard]] std::optional<cv::Mat> DarkSurround(const cv::Mat& frame);

// Returns 255 where there is a picture, and 0 in and close to the black surround that some lenses
// leave (a fisheye's circle on a larger chip). A lens without a surround has 255 everywhere.
[[nodiscard]] cv::Mat FieldOfView(const cv::Mat& frame);

}  // namespace trailcast::vision
