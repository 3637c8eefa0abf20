#include "services/vision/donut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trailcast::vision {
namespace {

constexpr int kSize = 240;
constexpr double kMiddle = (kSize - 1) / 2.0;

// A ring, grey 100, with a bright spot of some degrees at a bearing (0: ahead, which is up).
image::GrayImage Ring(double inner_px, double outer_px, double spot_bearing_rad) {
  image::GrayImage image{kSize, kSize, {}};
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double radius_px = std::hypot(x - kMiddle, y - kMiddle);
      const double bearing_rad = std::atan2(x - kMiddle, kMiddle - y);
      const bool lit = radius_px >= inner_px && radius_px <= outer_px;
      const bool spot = std::abs(bearing_rad - spot_bearing_rad) < 0.05;
      image.pixels.push_back(!lit ? 3 : spot ? 220 : 100);
    }
  }
  return image;
}

// Column of the brightest pixel half way down.
int BrightColumn(const image::GrayImage& image) {
  int best = 0;
  for (int x = 0; x < image.width; ++x) {
    if (image.at(x, image.height / 2) > image.at(best, image.height / 2)) best = x;
  }
  return best;
}

TEST(DonutUnroller, BearingsAreProportionalToU) {
  for (const double bearing_rad : {-1.2, -0.6, 0.0, 0.6, 1.2}) {
    DonutUnroller unroller;
    const image::GrayImage frame = Ring(36, 118, bearing_rad);
    const image::GrayImage& panorama = unroller.Unroll(frame);
    ASSERT_EQ(panorama.width, kSize);
    ASSERT_LT(panorama.height, kSize / 2);
    EXPECT_NEAR(BrightColumn(panorama), kMiddle + bearing_rad * kSize / std::numbers::pi, 5.0);
  }
}

TEST(DonutUnroller, ThePanoramaShowsNothingButTheRing) {
  DonutUnroller unroller;
  const image::GrayImage frame = Ring(36, 118, 3.0);
  for (const std::uint8_t pixel : unroller.Unroll(frame).pixels) EXPECT_NEAR(pixel, 100, 1);
}

TEST(DonutUnroller, LeavesAFisheyesCircleAlone) {
  DonutUnroller unroller;
  const image::GrayImage circle = Ring(0, 118, 0.5);
  EXPECT_EQ(&unroller.Unroll(circle), &circle);
}

TEST(DonutUnroller, LeavesAnOrdinaryPictureWithADarkDoorAlone) {
  DonutUnroller unroller;
  image::GrayImage room = Ring(0, 1000, 0.5);
  for (int y = 60; y < 240; ++y) {
    for (int x = 90; x < 150; ++x) room.pixels[image::PixelIndex(x, y, kSize)] = 2;
  }
  EXPECT_EQ(&unroller.Unroll(room), &room);
}

TEST(DonutUnroller, LeavesACircleWithADarkDoorAlone) {
  DonutUnroller unroller;
  image::GrayImage circle = Ring(0, 118, 0.5);
  for (int y = 70; y < 200; ++y) {
    for (int x = 100; x < 145; ++x) circle.pixels[image::PixelIndex(x, y, kSize)] = 2;
  }
  EXPECT_EQ(&unroller.Unroll(circle), &circle);
}

TEST(DonutUnroller, DecidesByTheFirstFrame) {
  DonutUnroller unroller;
  const image::GrayImage ring = Ring(36, 118, 0.0);
  EXPECT_NE(&unroller.Unroll(ring), &ring);
  const image::GrayImage dark{kSize, kSize, std::vector<std::uint8_t>(kSize * kSize, 0)};
  EXPECT_NE(&unroller.Unroll(dark), &dark);
}

}  // namespace
}  // namespace trailcast::vision
