#include "tests/support/second_camera.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "services/image/files.h"

namespace trailcast::test {
namespace {

struct Maps {
  cv::Mat x;
  cv::Mat y;
};

// For each pixel of the second camera the place in the first one's picture that it looks at.
Maps LookUp(const SecondCamera& camera, cv::Size from) {
  Maps maps{cv::Mat(camera.height, camera.width, CV_32F),
            cv::Mat(camera.height, camera.width, CV_32F)};
  const double half = 0.5 * camera.width;
  const double scale = camera.magnification * camera.width / from.width;
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const double u = column - 0.5 * (camera.width - 1);
      const double v = row - 0.5 * (camera.height - 1);
      // The straight radius whose bent one is this pixel's; a few steps are exact enough.
      const double bent = std::hypot(u, v) / half;
      double straight = bent;
      for (int i = 0; i < 8; ++i) straight = bent / (1.0 - camera.barrel * straight * straight);
      const double stretch = bent > 0.0 ? straight / bent : 1.0;
      maps.x.at<float>(row, column) =
          static_cast<float>(0.5 * (from.width - 1) + stretch * u / scale);
      maps.y.at<float>(row, column) =
          static_cast<float>(0.5 * (from.height - 1) + stretch * v / scale);
    }
  }
  return maps;
}

cv::Mat ResponseTable(double gamma) {
  cv::Mat table(1, 256, CV_8U);
  for (int grey = 0; grey < 256; ++grey) {
    table.at<std::uint8_t>(grey) =
        cv::saturate_cast<std::uint8_t>(255.0 * std::pow(grey / 255.0, gamma));
  }
  return table;
}

}  // namespace

image::GrayImage Through(const SecondCamera& camera, const image::GrayImage& frame) {
  image::GrayImage copy = frame;
  const cv::Mat source(frame.height, frame.width, CV_8U, copy.pixels.data());
  const Maps maps = LookUp(camera, source.size());
  image::GrayImage seen{camera.width, camera.height, {}};
  seen.pixels.resize(static_cast<std::size_t>(camera.width) *
                     static_cast<std::size_t>(camera.height));
  cv::Mat target(camera.height, camera.width, CV_8U, seen.pixels.data());
  cv::remap(source, target, maps.x, maps.y, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  cv::LUT(target, ResponseTable(camera.gamma), target);
  return seen;
}

void RecordThrough(const SecondCamera& camera, const std::filesystem::path& frames,
                   const std::filesystem::path& into) {
  std::filesystem::create_directories(into);
  auto sequence = image::FrameSequence::Open(frames);
  if (!sequence) throw std::runtime_error(sequence.error().message);
  for (int number = 0;; ++number) {
    auto frame = (*sequence)->Next();
    if (!frame) throw std::runtime_error(frame.error().message);
    if (!*frame) return;
    const auto written =
        image::WritePng(Through(camera, **frame), into / fmt::format("{:06}.png", number));
    if (!written) throw std::runtime_error(written.error().message);
  }
}

}  // namespace trailcast::test
