#include "agent/device/robot_measures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

image::GrayImage Blurred(const image::GrayImage& sharp, int reach) {
  image::GrayImage blurred = sharp;
  for (int y = 0; y < sharp.height; ++y) {
    for (int x = 0; x < sharp.width; ++x) {
      int sum = 0;
      for (int off = -reach; off <= reach; ++off) {
        sum += sharp.at(std::clamp(x + off, 0, sharp.width - 1), y);
      }
      blurred.pixels[image::PixelIndex(x, y, sharp.width)] =
          static_cast<std::uint8_t>(sum / (2 * reach + 1));
    }
  }
  return blurred;
}

TEST(MeasurePicture, TellsSharpFromBlurredWhateverTheContrast) {
  const image::GrayImage sharp = test::WalkFrame(0);
  image::GrayImage faint = sharp;
  for (std::uint8_t& pixel : faint.pixels) pixel = static_cast<std::uint8_t>(100 + pixel / 4);
  EXPECT_GT(MeasurePicture(sharp).sharpness, 0.34);
  EXPECT_GT(MeasurePicture(faint).sharpness, 0.34);
  EXPECT_LT(MeasurePicture(Blurred(sharp, 6)).sharpness, 0.34);
}

TEST(MeasurePicture, TellsBrightnessAndContrast) {
  image::GrayImage picture{4, 2, {0, 200, 0, 200, 0, 200, 0, 200}};
  EXPECT_DOUBLE_EQ(MeasurePicture(picture).brightness, 100.0);
  EXPECT_DOUBLE_EQ(MeasurePicture(picture).contrast, 100.0);
  std::fill(picture.pixels.begin(), picture.pixels.end(), std::uint8_t{7});
  EXPECT_DOUBLE_EQ(MeasurePicture(picture).contrast, 0.0);
  EXPECT_DOUBLE_EQ(MeasurePicture(picture).sharpness, 0.0);
}

}  // namespace
}  // namespace trailcast::agent
