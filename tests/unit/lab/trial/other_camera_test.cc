#include "services/lab/trial/recording/src/other_camera.h"

#include <gtest/gtest.h>

#include "tests/support/painted_wall.h"

namespace trailcast::trial {
namespace {

// A camera that changes nothing, but for what a test asks of it.
OtherCamera Same(int width, int height) {
  OtherCamera camera;
  camera.width = width;
  camera.height = height;
  camera.magnification = 1.0;
  camera.barrel = 0.0;
  camera.gamma = 1.0;
  return camera;
}

int Difference(const image::GrayImage& one, const image::GrayImage& other, int margin) {
  int largest = 0;
  for (int y = margin; y < one.height - margin; ++y) {
    for (int x = margin; x < one.width - margin; ++x) {
      largest = std::max(largest, std::abs(one.at(x, y) - other.at(x, y)));
    }
  }
  return largest;
}

TEST(OtherCamera, TheSameOneSeesTheSame) {
  const image::GrayImage frame = test::PaintedWall(3).Photograph({});
  EXPECT_EQ(Through(Same(320, 240), frame).pixels, frame.pixels);
}

TEST(OtherCamera, MagnifiesAsALongerLensWould) {
  const test::PaintedWall wall(3);
  OtherCamera longer = Same(320, 240);
  longer.magnification = 1.5;
  const image::GrayImage seen = Through(longer, wall.Photograph({}));
  // Magnifying a picture blurs it a little.
  EXPECT_LT(Difference(seen, wall.Photograph({.scale = 1.5}), 2), 25);
  EXPECT_GT(Difference(seen, wall.Photograph({}), 2), 60);
}

TEST(OtherCamera, BarrelDrawsTheEdgeInAndLeavesTheMiddle) {
  const image::GrayImage stripes = [] {
    image::GrayImage picture{200, 100, std::vector<std::uint8_t>(20000)};
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      picture.pixels[i] = (i % 200 >= 150 && i % 200 < 160) ? 250 : 20;
    }
    return picture;
  }();
  OtherCamera bent = Same(200, 100);
  bent.barrel = 0.1;
  const image::GrayImage seen = Through(bent, stripes);
  // 55 pixels from the middle, of half a width of 100: 0.55 (1 - 0.1 * 0.55^2) = 0.533.
  EXPECT_GT(seen.at(153, 50), 200);
  EXPECT_LT(seen.at(159, 50), 60);
  EXPECT_EQ(seen.at(100, 50), 20);
}

TEST(OtherCamera, GammaBelowOneBrightens) {
  OtherCamera bright = Same(4, 4);
  bright.gamma = 0.5;
  const image::GrayImage frame{4, 4, std::vector<std::uint8_t>(16, 64)};
  EXPECT_EQ(Through(bright, frame).at(1, 1), 128);  // 255 sqrt(64 / 255) = 127.7
}

}  // namespace
}  // namespace trailcast::trial
