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
    stored.push_back({described.patch, {}, {{0.0F, u, v}, {1.0F, u, v}}});
  }
  return stored;
}

// How many of those found are where they should be, and whether nearly all are.
std::size_t CountRight(const std::vector<route::Feature>& stored, const FindResult& found,
                       const test::PaintedWall::View& view) {
  std::size_t right = 0;
  for (const auto& feature : found.features) {
    const auto& taught = stored[static_cast<std::size_t>(feature.id)].first();
    const double cosine = view.scale * std::cos(view.roll_rad);
    const double sine = view.scale * std::sin(view.roll_rad);
    right += std::hypot(feature.u_px - (cosine * taught.u_px - sine * taught.v_px + view.du_px),
                        feature.v_px - (sine * taught.u_px + cosine * taught.v_px + view.dv_px)) <
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

// How many of the features a robot still sees that rolls, pitches and heads elsewhere.
std::size_t InView(const std::vector<route::Feature>& stored, const test::PaintedWall::View& view) {
  return static_cast<std::size_t>(
      std::count_if(stored.begin(), stored.end(), [&](const auto& each) {
        const double u = each.first().u_px;
        const double v = each.first().v_px;
        return std::abs(std::cos(view.roll_rad) * u - std::sin(view.roll_rad) * v + view.du_px) <
                   154.0 &&
               std::abs(std::sin(view.roll_rad) * u + std::cos(view.roll_rad) * v + view.dv_px) <
                   114.0;
      }));
}

TEST(FindTilted, FindsFiveOfSixWhoseViewIsRolledAndPitched) {
  const auto stored = Stored();
  for (const double roll_rad : {-0.1, 0.1, 0.15}) {
    const test::PaintedWall::View view{
        .du_px = 12.0, .dv_px = 30.0, .noise_grey = 2.5, .noise_seed = 5, .roll_rad = roll_rad};
    const image::GrayImage frame = kWall.Photograph(view);
    const auto found =
        FeatureFinder().FindTilted(frame, stored, Expected(stored), 1.0, {56.0, 56.0});
    EXPECT_GE(CountRight(stored, found, view) * 6, InView(stored, view) * 5) << roll_rad;
    const auto upright =
        FeatureFinder().FindNear(frame, stored, Expected(stored), 1.0, {56.0, 56.0});
    EXPECT_LT(upright.features.size() * 4, InView(stored, view) * 3) << roll_rad;
  }
}

TEST(FindTilted, FindsThemThroughAnotherMagnificationThatIsKnown) {
  const auto stored = Stored();
  const test::PaintedWall::View view{
      .scale = 1.5, .du_px = 3.0, .noise_grey = 2.0, .roll_rad = 0.05};
  const auto found = FeatureFinder().FindTilted(kWall.Photograph(view), stored,
                                                Expected(stored, 1.5), 1.5, {56.0, 56.0});
  EXPECT_GE(CountRight(stored, found, view), 15U);
}

TEST(FindTilted, FindsNoMoreOnAnotherWallThanChanceHas) {
  const auto stored = Stored();
  const auto found = FeatureFinder().FindTilted(test::PaintedWall(77).Photograph({}), stored,
                                                Expected(stored), 1.0, {56.0, 56.0});
  EXPECT_LE(found.features.size(), stored.size() / 3);
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

}  // namespace
}  // namespace trailcast::vision
