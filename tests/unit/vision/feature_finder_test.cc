#include "services/vision/feature_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/vision/feature_tracker.h"
#include "tests/support/painted_wall.h"

namespace trailcast::vision {
namespace {

const test::PaintedWall kWall(3);

std::vector<route::Feature> Stored() {
  FeatureTracker tracker;
  tracker.Track(kWall.Photograph({.noise_grey = 2.0}));
  tracker.Detect();
  std::vector<route::Feature> stored;
  for (const auto& described : tracker.Describe()) {
    const auto u = static_cast<float>(described.at.u_px);
    const auto v = static_cast<float>(described.at.v_px);
    stored.push_back({described.patch, described.descriptor, {{0.0F, u, v}, {1.0F, u, v}}});
  }
  return stored;
}

// How many of those found are where they should be, and whether nearly all are.
std::size_t CountRight(const std::vector<route::Feature>& stored, const FindResult& found,
                       const test::PaintedWall::View& view) {
  std::size_t right = 0;
  for (const auto& feature : found.features) {
    const auto& taught = stored[static_cast<std::size_t>(feature.id)].first();
    right += std::hypot(feature.u_px - (view.scale * taught.u_px + view.du_px),
                        feature.v_px - (view.scale * taught.v_px + view.dv_px)) <
             2.0 * std::max(1.0, view.scale);
  }
  EXPECT_GE(right * 10, found.features.size() * 9) << "more than a tenth is misplaced";
  return right;
}

// The stored features' own places, seen at a magnification.
std::vector<route::TrackedFeature> Expected(const std::vector<route::Feature>& stored,
                                            double magnification = 1.0) {
  std::vector<route::TrackedFeature> expected;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    expected.push_back({static_cast<int>(i), magnification * stored[i].first().u_px,
                        magnification * stored[i].first().v_px});
  }
  return expected;
}

TEST(FindNear, FindsNearlyAllAfterASmallMoveUnderAnotherGain) {
  const auto stored = Stored();
  ASSERT_GE(stored.size(), 40U);
  for (const double gain : {0.7, 1.0, 1.3}) {
    const test::PaintedWall::View view{
        .du_px = 9.0, .dv_px = -4.0, .gain = gain, .noise_grey = 2.5, .noise_seed = 5};
    const auto found =
        FeatureFinder().FindNear(kWall.Photograph(view), stored, Expected(stored), 1.0, {});
    EXPECT_GE(CountRight(stored, found, view) * 10, stored.size() * 7) << "gain " << gain;
  }
}

TEST(FindNear, FindsThemThroughAnotherMagnificationThatIsKnown) {
  const auto stored = Stored();
  for (const double scale : {0.6, 0.8, 1.5}) {
    const test::PaintedWall::View view{.scale = scale, .du_px = 3.0, .noise_grey = 2.0};
    const auto found = FeatureFinder().FindNear(kWall.Photograph(view), stored,
                                                Expected(stored, scale), scale, {});
    EXPECT_GE(CountRight(stored, found, view), 15U) << "scale " << scale;
    EXPECT_NEAR(found.magnification, scale, 0.02 * scale);
  }
}

TEST(FindNear, SaysHowManyShouldBeInThePicture) {
  const auto stored = Stored();
  const auto found = FeatureFinder().FindNear(kWall.Photograph({.scale = 2.0}), stored,
                                              Expected(stored, 2.0), 2.0, {});
  EXPECT_GT(found.in_picture, 5);
  EXPECT_LT(found.in_picture, static_cast<int>(stored.size()) / 2);
  EXPECT_TRUE(found.BeyondChance());
}

TEST(FindAtAnyMagnification, FindsAViewOfAnyCamera) {
  const auto stored = Stored();
  for (const double scale : {0.35, 0.7, 1.0, 1.6, 2.5}) {
    const test::PaintedWall::View view{
        .scale = scale, .du_px = 6.0 * scale, .dv_px = -3.0 * scale, .noise_grey = 2.0};
    const auto found =
        FeatureFinder().FindAtAnyMagnification(kWall.Photograph(view), stored, 0.0, {45.0, 22.0});
    EXPECT_TRUE(found.BeyondChance()) << scale;
    EXPECT_GE(2 * CountRight(stored, found, view), static_cast<std::size_t>(found.in_picture));
    EXPECT_NEAR(found.magnification, scale, 0.04 * scale);
  }
}

TEST(FindAtAnyMagnification, FindsNothingOnAnotherWall) {
  const auto stored = Stored();
  for (const unsigned wall : {77U, 78U, 79U}) {
    const auto found = FeatureFinder().FindAtAnyMagnification(
        test::PaintedWall(wall).Photograph({.noise_grey = 2.0}), stored, 0.0, {45.0, 22.0});
    EXPECT_TRUE(found.features.empty());
  }
}

TEST(FindNear, FindsNothingOnAnotherWall) {
  const auto stored = Stored();
  const auto found = FeatureFinder().FindNear(test::PaintedWall(77).Photograph({}), stored,
                                              Expected(stored), 1.0, {});
  EXPECT_LE(found.features.size(), stored.size() / 3);
}

TEST(FindWide, FindsTheMagnificationWithoutBeingTold) {
  const auto stored = Stored();
  for (const double scale : {0.5, 0.7, 1.0, 1.4, 1.9}) {
    const test::PaintedWall::View view{
        .scale = scale, .du_px = -12.0, .dv_px = 6.0, .noise_grey = 2.0};
    const auto found = FeatureFinder().FindWide(kWall.Photograph(view), stored, 0.0);
    ASSERT_GT(found.matches, 0) << "scale " << scale;
    EXPECT_NEAR(found.fit.scale, scale, 0.06 * scale);
    EXPECT_NEAR(found.fit.du_px, -12.0, 4.0);
  }
}

TEST(FindWide, SaysNothingRatherThanSomethingWrong) {
  const auto stored = Stored();
  const auto other = test::PaintedWall(77).Photograph({});
  EXPECT_EQ(FeatureFinder().FindWide(other, stored, 0.0).matches, 0);
  const auto blank = test::PaintedWall(1, 0).Photograph({.noise_grey = 3.0});
  EXPECT_EQ(FeatureFinder().FindWide(blank, stored, 0.0).matches, 0);
}

}  // namespace
}  // namespace trailcast::vision
