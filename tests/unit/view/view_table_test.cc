#include "services/view/view_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace trailcast::view {
namespace {

constexpr double kWidth_px = 320.0;

route::View RandomView(unsigned seed, int features = 40) {
  std::mt19937 random(seed);
  route::View view(static_cast<std::size_t>(features));
  for (route::ViewFeature& feature : view) {
    for (std::uint8_t& byte : feature.descriptor) byte = static_cast<std::uint8_t>(random());
    feature.u_px = static_cast<float>(random() % 300U) - 150.0F;
    feature.v_px = static_cast<float>(random() % 200U) - 100.0F;
    feature.size_px = 1.0F;
  }
  return view;
}

route::View Seen(route::View view, double scale, double shift_u_px, int flipped_bits = 30) {
  std::mt19937 random(3);
  for (route::ViewFeature& feature : view) {
    feature.u_px = static_cast<float>(scale * feature.u_px + shift_u_px);
    feature.v_px = static_cast<float>(scale * feature.v_px);
    feature.size_px = static_cast<float>(scale * feature.size_px);
    for (int i = 0; i < flipped_bits; ++i) {
      feature.descriptor[random() % 32U] ^= static_cast<std::uint8_t>(1U << (random() % 8U));
    }
  }
  return view;
}

Comparison CompareViews(const route::View& key, const route::View& seen) {
  return Compare(Tabulate(key, kWidth_px), Tabulate(seen, kWidth_px));
}

TEST(CompareViews, FindsMagnificationAndShift) {
  const route::View key = RandomView(1);
  for (const double scale : {0.5, 0.8, 1.0, 1.3, 2.0}) {
    const Comparison match = CompareViews(key, Seen(key, scale, 16.0));
    EXPECT_GE(match.agreed(), 38);
    EXPECT_NEAR(match.scale, scale, 1e-3);
    EXPECT_NEAR(match.shift_u, 0.1, 1e-3);
    EXPECT_NEAR(match.shift_v, 0.0, 1e-3);
    for (const Comparison::Pair& pair : match.pairs) EXPECT_EQ(pair.key, pair.seen);
  }
}

TEST(CompareViews, WidthsOfThePicturesDoNotMatter) {
  const route::View key = RandomView(1);
  const Comparison match =
      Compare(Tabulate(key, kWidth_px), Tabulate(Seen(key, 4.0, 0.0), 4.0 * kWidth_px));
  EXPECT_GE(match.agreed(), 38);
  EXPECT_NEAR(match.scale, 1.0, 1e-3);
}

TEST(CompareViews, StrangersHaveNextToNothingInCommon) {
  for (unsigned other = 2; other < 20; ++other) {
    EXPECT_LE(CompareViews(RandomView(1), RandomView(other, 300)).agreed(), 3);
  }
}

TEST(CompareViews, AnotherArrangementDoesNotAgree) {
  const route::View key = RandomView(1);
  route::View seen = Seen(key, 1.0, 0.0);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i].u_px = key[(7 * i + 3) % key.size()].u_px;
    seen[i].v_px = key[(7 * i + 3) % key.size()].v_px;
  }
  EXPECT_LE(CompareViews(key, seen).agreed(), 5);
}

TEST(CompareViews, SizesThatContradictTheMagnificationDoNotAgreeAndUnknownOnesDo) {
  const route::View key = RandomView(1);
  route::View seen = Seen(key, 1.0, 0.0);
  for (route::ViewFeature& feature : seen) feature.size_px = 2.0F;
  EXPECT_LE(CompareViews(key, seen).agreed(), 3);
  for (route::ViewFeature& feature : seen) feature.size_px = 0.0F;
  EXPECT_GE(CompareViews(key, seen).agreed(), 38);
}

TEST(CompareViews, TheSameCornerOnTheNextLevelOfThePyramidIsNoRival) {
  const route::View key = RandomView(1);
  route::View seen = Seen(key, 1.0, 0.0);
  for (const route::ViewFeature& feature : Seen(key, 1.0, 0.0, 34)) {
    seen.push_back(feature);
    seen.back().u_px += 1.0F;
    seen.back().size_px = 1.2F;
  }
  EXPECT_GE(CompareViews(key, seen).agreed(), 36);
}

TEST(CompareViews, OneFeatureThatAllOthersLookLikeCountsOnce) {
  route::View key = RandomView(1);
  for (route::ViewFeature& feature : key) feature.descriptor = key.front().descriptor;
  EXPECT_LE(CompareViews(key, RandomView(1)).agreed(), 1);
}

TEST(CompareViews, EmptyAndUndescribedViewsMatchNothing) {
  const route::View view = RandomView(1);
  EXPECT_EQ(CompareViews({}, view).agreed(), 0);
  EXPECT_EQ(CompareViews(view, {}).agreed(), 0);
  route::View undescribed = view;
  for (route::ViewFeature& feature : undescribed) feature.descriptor = {};
  EXPECT_EQ(Tabulate(undescribed, kWidth_px).size(), 0U);
}

TEST(Spread, KeepsTheStrongestAndLeavesOutWhatIsCloseToIt) {
  route::View view;
  for (int i = 0; i < 20; ++i) {
    view.push_back({{1}, static_cast<float>(i % 2 == 0 ? 10 * i : 10 * (i - 1) + 1), 0.0F, 1.0F});
  }
  const route::View kept = Spread(view, 10);
  ASSERT_EQ(kept.size(), 10U);
  EXPECT_EQ(kept.front(), view.front());
  for (const route::ViewFeature& feature : kept) {
    EXPECT_EQ(std::fmod(feature.u_px, 20.0F), 0.0F);
  }
  EXPECT_EQ(Spread(view, 30), view);
}

}  // namespace
}  // namespace trailcast::view
