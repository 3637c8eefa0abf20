#pragma once

#include <opencv2/core.hpp>

#include "services/image/image.h"

namespace trailcast::trial {

// Returns OpenCV's view of the picture, which keeps its pixels.
[[nodiscard]] inline cv::Mat View(image::GrayImage& picture) {
  return {picture.height, picture.width, CV_8U, picture.pixels.data()};
}
// Only for reading, which OpenCV's views cannot express.
[[nodiscard]] inline cv::Mat View(const image::GrayImage& picture) {
  return {picture.height, picture.width, CV_8U, const_cast<std::uint8_t*>(picture.pixels.data())};
}
[[nodiscard]] inline image::GrayImage Blank(int width, int height) {
  return {width, height,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height))};
}

}  // namespace trailcast::trial
