#include "services/lab/trial/align/src/camera_mask.h"

#include <gtest/gtest.h>

namespace trailcast::trial {
namespace {

// A fisheye's picture: something else each time in a disc, black around it, a light hood below.
image::GrayImage Fisheye(int number) {
  image::GrayImage picture{100, 80, std::vector<std::uint8_t>(8000, 3)};
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 100; ++x) {
      const int u = x - 50;
      const int v = y - 40;
      std::uint8_t& grey = picture.pixels[image::PixelIndex(x, y, 100)];
      if (u * u + v * v < 38 * 38)
        grey = static_cast<std::uint8_t>(37 * (x + y + 3 * number) % 200);
      if (y > 68) grey = 180;
    }
  }
  return picture;
}

TEST(CameraMask, CoversWhatNeverChanges) {
  CameraMask mask;
  for (int i = 0; i < 12; ++i) mask.Add(Fisheye(i));
  const image::GrayImage found = mask.Find();
  ASSERT_EQ(found.width, 100);
  EXPECT_EQ(found.at(50, 40), 255);
  EXPECT_EQ(found.at(30, 30), 255);
  EXPECT_EQ(found.at(5, 5), 0);
  EXPECT_EQ(found.at(50, 75), 0);
  // With a margin about it, where a corner would half belong to the camera.
  EXPECT_EQ(found.at(50, 68), 0);
}

TEST(CameraMask, AFewFramesTellNothing) {
  CameraMask mask;
  EXPECT_TRUE(mask.Find().empty());
  for (int i = 0; i < 11; ++i) mask.Add(Fisheye(i));
  EXPECT_TRUE(mask.Find().empty());
}

TEST(CameraMask, ARobotThatStoodHasNoMask) {
  CameraMask mask;
  for (int i = 0; i < 12; ++i) mask.Add(Fisheye(0));
  EXPECT_TRUE(mask.Find().empty());
}

}  // namespace
}  // namespace trailcast::trial
