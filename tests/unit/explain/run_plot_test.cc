#include "services/explain/run_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/plot/plot_style.h"
#include "tests/support/recorded/sample_run.h"

namespace trailcast::explain {
namespace {

using agent::Phase;
using image::Color;
using test::SampleRun;

Color At(const image::RgbImage& picture, int x, int y) {
  const std::size_t i = 3 * image::PixelIndex(x, y, picture.width);
  return {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]};
}

// The columns in which a colour takes up a good part of the picture's height.
std::vector<int> ColumnsOf(const image::RgbImage& picture, Color color) {
  std::vector<int> columns;
  for (int x = 0; x < picture.width; ++x) {
    int count = 0;
    for (int y = 0; y < picture.height; ++y) count += At(picture, x, y) == color ? 1 : 0;
    if (count > 200) columns.push_back(x);
  }
  return columns;
}

SampleRun Straight() {
  SampleRun run;
  run.HandOver(0, 27).Frames(49).HandOver(1, 28).Frames(50);  // 4 m
  return run;
}

TEST(DrawRun, AllRunsAreEquallyWideAndLowerWithoutAPath) {
  const image::RgbImage with = DrawRun(Straight().Log()).Render();
  SampleRun blind;
  blind.row().driven_m = blind.row().x_m = blind.row().y_m = std::nullopt;
  const image::RgbImage without = DrawRun(blind.HandOver(0, 27).Frames(99).Log()).Render();
  EXPECT_EQ(with.width, 1200);
  EXPECT_EQ(without.width, 1200);
  EXPECT_LT(without.height, with.height - 100);
}

TEST(DrawRun, ABandStandsWhereTheRobotWasUnsure) {
  SampleRun run;
  run.HandOver(0, 27).Frames(49);                             // to 2 m
  run.Phase(Phase::kUnsure, "few").Frames(25);                // to 3 m
  run.Phase(Phase::kSure, "").Frames(25).End("ARRIVED", "");  // to 4 m
  const auto columns = ColumnsOf(DrawRun(run.Log()).Render(), PhaseColor(Phase::kUnsure));
  ASSERT_FALSE(columns.empty());
  // The charts are 1116 px wide from 62 on.
  EXPECT_NEAR(columns.front(), 62 + 1116 * 2.0 / 4.0, 15.0);
  EXPECT_NEAR(columns.back(), 62 + 1116 * 3.0 / 4.0, 15.0);
  EXPECT_TRUE(ColumnsOf(DrawRun(Straight().Log()).Render(), PhaseColor(Phase::kUnsure)).empty());
}

TEST(DrawRun, ARobotThatStoodIsSeenAllTheSame) {
  SampleRun run;
  run.HandOver(0, 27).Frames(49);
  run.row().linear_mps = 0.0;
  run.Phase(Phase::kCovered, "covered").Frames(60);
  run.row().linear_mps = 0.4;
  run.Phase(Phase::kSure, "").Frames(50);
  EXPECT_GE(ColumnsOf(DrawRun(run.Log()).Render(), PhaseColor(Phase::kCovered)).size(), 2U);
}

TEST(DrawRun, OneThatNeverMovedIsDrawnOverTime) {
  SampleRun run;
  run.row().linear_mps = 0.0;
  run.Phase(Phase::kSeeking, "not found").HandOver(0, 1).Frames(50);
  const auto columns = ColumnsOf(DrawRun(run.Log()).Render(), PhaseColor(Phase::kSeeking));
  EXPECT_GT(columns.size(), 1000U) << "it sought all the time";
}

TEST(DrawRun, AnEmptyLogStillMakesAPicture) {
  EXPECT_EQ(DrawRun(SampleRun().Log()).Render().width, 1200);
  EXPECT_EQ(DrawRun(SampleRun().Frame().Log()).Render().width, 1200);
}

}  // namespace
}  // namespace trailcast::explain
