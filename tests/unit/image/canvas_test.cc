#include "services/image/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace trailcast::image {
namespace {

constexpr Color kWhite = {255, 255, 255};
constexpr Color kRed = {255, 0, 0};

Color At(const Canvas& canvas, int x, int y) {
  const RgbImage& picture = canvas.picture();
  const auto i = 3 * PixelIndex(x, y, picture.width);
  return {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]};
}

int CountUnlike(const Canvas& canvas, Color background, int x0, int x1) {
  int count = 0;
  for (int y = 0; y < canvas.picture().height; ++y) {
    for (int x = x0; x < x1; ++x) count += At(canvas, x, y) != background ? 1 : 0;
  }
  return count;
}

TEST(Canvas, StartsInItsBackground) {
  const Canvas canvas(5, 4, kRed);
  EXPECT_EQ(canvas.picture().width, 5);
  EXPECT_EQ(canvas.picture().height, 4);
  EXPECT_EQ(canvas.picture().pixels.size(), 60U);
  EXPECT_EQ(At(canvas, 4, 3), kRed);
}

TEST(Canvas, PolygonFillsItsInsideOnly) {
  Canvas canvas(20, 20, kWhite);
  canvas.FillPolygon({{5, 5}, {15, 5}, {15, 15}, {5, 15}}, kRed);
  EXPECT_EQ(At(canvas, 10, 10), kRed);
  EXPECT_EQ(At(canvas, 2, 10), kWhite);
  EXPECT_EQ(At(canvas, 18, 10), kWhite);
}

TEST(Canvas, ABoxIsFilledOrOutlined) {
  Canvas filled(20, 20, kWhite);
  filled.FillBox({5, 5}, {15, 12}, kRed);
  EXPECT_EQ(At(filled, 10, 8), kRed);
  EXPECT_EQ(At(filled, 10, 16), kWhite);
  Canvas outlined(20, 20, kWhite);
  outlined.OutlineBox({4, 4}, {16, 15}, kRed, 3.0);
  EXPECT_EQ(At(outlined, 10, 10), kWhite);
  for (const auto& [x, y] :
       {std::pair(10, 4), std::pair(10, 15), std::pair(4, 10), std::pair(16, 10)}) {
    EXPECT_EQ(At(outlined, x, y), kRed) << x << ", " << y;
  }
}

TEST(Canvas, DashedLineLeavesGapsThatAFullLineDoesNot) {
  Canvas full(100, 9, kWhite);
  full.Line({{0, 4}, {99, 4}}, kRed, 1.0);
  Canvas dashed(100, 9, kWhite);
  dashed.Line({{0, 4}, {40, 4}, {99, 4}}, kRed, 1.0, true);
  int full_px = 0;
  int dashed_px = 0;
  for (int x = 0; x < 100; ++x) {
    full_px += At(full, x, 4)[2] < 128 ? 1 : 0;
    dashed_px += At(dashed, x, 4)[2] < 128 ? 1 : 0;
  }
  EXPECT_GE(full_px, 98);
  EXPECT_GT(dashed_px, 35);
  EXPECT_LT(dashed_px, 75);
}

TEST(Canvas, DiscAndCrossMarkTheirCentre) {
  Canvas canvas(40, 20, kWhite);
  canvas.Disc({10, 10}, 4.0, kRed);
  canvas.Cross({30, 10}, 5.0, kRed, 1.0);
  EXPECT_EQ(At(canvas, 10, 10), kRed);
  EXPECT_EQ(At(canvas, 10, 16), kWhite);
  EXPECT_EQ(At(canvas, 30, 10), kRed);
  EXPECT_EQ(At(canvas, 30, 3), kWhite);
}

TEST(Canvas, CapitalsHaveTheHeightAskedFor) {
  Canvas canvas(200, 100, kWhite);
  canvas.Text("HI", {20, 70}, 40.0, {0, 0, 0});
  int top = 100;
  int bottom = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      if (At(canvas, x, y)[0] < 128) {
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
    }
  }
  EXPECT_NEAR(bottom, 70, 3);
  EXPECT_NEAR(bottom - top, 40, 5);
}

TEST(Canvas, TextStaysWithinItsWidth) {
  Canvas canvas(300, 40, kWhite);
  const double width = Canvas::TextWidth("Trailcast", 14.0);
  canvas.Text("Trailcast", {10, 25}, 14.0, {0, 0, 0});
  const int end = 10 + static_cast<int>(width);
  EXPECT_GT(CountUnlike(canvas, kWhite, 10, end), 50);
  EXPECT_EQ(CountUnlike(canvas, kWhite, end + 3, 300), 0);
}

TEST(Canvas, PasteScalesAndIsCutAtTheBorder) {
  Canvas small(2, 2, kRed);
  Canvas canvas(20, 20, kWhite);
  canvas.Paste(small.picture(), 15, -3, 10, 10);
  EXPECT_EQ(At(canvas, 17, 3), kRed);
  EXPECT_EQ(At(canvas, 14, 3), kWhite);
  EXPECT_EQ(At(canvas, 17, 8), kWhite);
  canvas.Paste(small.picture(), 50, 50, 10, 10);
  EXPECT_EQ(At(canvas, 10, 10), kWhite);
}

}  // namespace
}  // namespace trailcast::image
