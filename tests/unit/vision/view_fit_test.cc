#include "services/vision/view_fit.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace trailcast::vision {
namespace {

std::vector<ViewPair> Pairs(const ViewFit& fit, int count, int mismatched) {
  std::mt19937 random(11);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  std::vector<ViewPair> pairs;
  for (int i = 0; i < count; ++i) {
    const double u = uniform(-150, 150);
    const double v = uniform(-110, 110);
    pairs.push_back({u, v, fit.MapU(u), fit.MapV(v)});
    if (i < mismatched) pairs.back().u_px = uniform(-150, 150);
    if (i < mismatched) pairs.back().v_px = uniform(-110, 110);
  }
  return pairs;
}

TEST(ViewFit, RecoversScaleAndShiftExactly) {
  const ViewFit truth{0.8, 5.0, -3.0};
  const ViewFitResult result = FitView(Pairs(truth, 30, 0));
  EXPECT_NEAR(result.fit.scale, 0.8, 1e-9);
  EXPECT_NEAR(result.fit.du_px, 5.0, 1e-9);
  EXPECT_NEAR(result.fit.dv_px, -3.0, 1e-9);
  EXPECT_EQ(result.inliers, 30);
}

TEST(ViewFit, HalfOfThemMayBeWrong) {
  const ViewFitResult result = FitView(Pairs({1.7, 5.0, -3.0}, 40, 20));
  EXPECT_NEAR(result.fit.scale, 1.7, 0.05);
  EXPECT_GE(result.inliers, 20);
}

TEST(ViewFit, ScalesOutOfBoundsAreNotConsidered) {
  EXPECT_EQ(FitView(Pairs({8.0, 0.0, 0.0}, 20, 0), {.tolerance_u_px = 1.0}).inliers, 0);
}

TEST(ViewFit, PairsCloseTogetherDoNotPullTheScaleOutOfBounds) {
  // Only the first two are of a scale within bounds; least squares over all four gives 0.33.
  const std::vector<ViewPair> pairs{{0, 0, 0, 0}, {8.1, 0, 8.1, 0}, {-8, 0, 1, 0}, {16, 0, 7, 0}};
  const ViewFitResult result = FitView(pairs, {.min_scale = 0.5, .max_scale = 2.0});
  EXPECT_EQ(result.inliers, 4);
  EXPECT_NEAR(result.fit.scale, 1.0, 1e-9);
}

TEST(ViewFit, OnePairTellsNothing) {
  EXPECT_EQ(FitView(Pairs({1.0, 0.0, 0.0}, 1, 0)).inliers, 0);
  EXPECT_EQ(FitView({}).inliers, 0);
}

}  // namespace
}  // namespace trailcast::vision
