#include "services/plot/strip_chart.h"

#include <gtest/gtest.h>

#include "services/plot/plot_style.h"

namespace trailcast::plot {
namespace {

using image::Color;

Color At(const image::RgbImage& picture, int x, int y) {
  const std::size_t i = 3 * image::PixelIndex(x, y, picture.width);
  return {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]};
}

TEST(DrawStrip, PutsAValueAtItsHeight) {
  constexpr Color kRed{255, 0, 0};
  Drawing drawing(200, 150, {255, 255, 255});
  ChartAxis axis{"x", {0.0, 10.0}, {}, {}};
  StripChart chart{"", {{"", kRed, {0.75, 0.75}, 3.0, false}}, 0.0, 1.0};
  DrawStrip(drawing, {20.0, 20.0, 160.0, 100.0}, axis, chart);
  EXPECT_EQ(At(drawing.Render(), 100, 45), kRed);
  EXPECT_NE(At(drawing.Render(), 100, 95), kRed);
}

TEST(DrawStrip, WhereThereIsNoValueTheCurveHasAGap) {
  constexpr Color kRed{255, 0, 0};
  Drawing drawing(200, 150, {255, 255, 255});
  ChartAxis axis{"x", {0.0, 2.0, 8.0, 10.0}, {}, {}};
  StripChart chart{"", {{"", kRed, {0.75, 0.75, std::nullopt, 0.75}, 3.0, false}}, 0.0, 1.0};
  DrawStrip(drawing, {20.0, 20.0, 160.0, 100.0}, axis, chart);
  EXPECT_EQ(At(drawing.Render(), 40, 45), kRed);
  EXPECT_NE(At(drawing.Render(), 100, 45), kRed);
}

TEST(RoundTicks, AreRoundAndInside) {
  const auto ticks = RoundTicks(-0.07, 0.23, 4.0);
  ASSERT_GE(ticks.size(), 3U);
  EXPECT_GE(ticks.front(), -0.07);
  EXPECT_LE(ticks.back(), 0.23);
  EXPECT_NEAR(ticks[1] - ticks[0], 0.1, 1e-9);
}

}  // namespace
}  // namespace trailcast::plot
