#include "services/route/backwards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/route/sample_segment.h"

namespace trailcast::route {
namespace {

using testing::HasSubstr;

double HeadingAt(const HeadingPolynomial& heading, double along_m) {
  return along_m * (heading.c[0] + along_m * (heading.c[1] + along_m * heading.c[2]));
}

// A dark bar through its middle, so many samples wide.
Patch Bar(double wide) {
  Patch patch{};
  for (int row = 0; row < kPatchSize; ++row) {
    for (int column = 0; column < kPatchSize; ++column) {
      const bool dark = std::abs(column - (kPatchSize - 1) / 2) <= wide / 2;
      patch.at(static_cast<std::size_t>(row) * kPatchSize + static_cast<std::size_t>(column)) =
          dark ? 2 : 14;
    }
  }
  return patch;
}

int DarkInARow(const Patch& patch) {
  return static_cast<int>(
      std::count_if(patch.begin(), patch.begin() + kPatchSize, [](int grey) { return grey < 8; }));
}

// Its features end `growth` times as far from the picture's centre.
Segment GrowingSegment(float growth) {
  Segment segment = SampleSegmentWithKeyViews(0, 0);
  for (const auto& [u, v] : {std::pair(-40.0F, -20.0F), {40.0F, -20.0F}, {0.0F, 40.0F}}) {
    Feature& feature = segment.features.emplace_back();
    feature.patch = Bar(2.0);
    feature.track = {{0.0F, u, v}, {1.0F, growth * u, growth * v}};
  }
  return segment;
}

TEST(Backwards, FromTheOtherEndAndBackItIsTheSameSegment) {
  const Segment segment = SampleSegmentWithKeyViews(0, 5);
  const Segment back = FromOtherEnd(FromOtherEnd(segment));
  EXPECT_EQ(back.features.front().patch, segment.features.front().patch);
  EXPECT_EQ(back.key_views.size(), segment.key_views.size());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back.heading.c[i], segment.heading.c[i], 1e-12);
  for (std::size_t i = 0; i < segment.features.size(); ++i) {
    const auto& track = segment.features[i].track;
    for (std::size_t k = 0; k < track.size(); ++k) {
      EXPECT_NEAR(back.features[i].track[k].s, track[k].s, 1e-6);
      EXPECT_EQ(back.features[i].track[k].u_px, track[k].u_px);
    }
  }
}

TEST(Backwards, AKeyViewThatWasAddedStaysBehindTheScoutsOwn) {
  Segment segment = SampleSegmentWithKeyViews(0, 5);
  KeyView added = segment.key_views[2];
  added.missed = 1;
  segment.key_views.insert(segment.key_views.begin() + 3, added);
  const Segment back = FromOtherEnd(segment);
  ASSERT_EQ(back.key_views.size(), 5U);
  EXPECT_FALSE(back.key_views[1].missed);
  EXPECT_EQ(back.key_views[2].missed, 1);
  EXPECT_EQ(back.key_views[1].s, back.key_views[2].s);
}

TEST(Backwards, PlacesAndHeadingsAreThoseOfTheSamePlacesOfTheRoute) {
  Segment segment = SampleSegmentWithKeyViews(0, 5);
  segment.terrain.slope_rad = 0.05;
  const Segment other = FromOtherEnd(segment);
  const Feature& feature = segment.features.front();
  EXPECT_EQ(other.features.front().first().u_px, feature.milestone().u_px);
  EXPECT_EQ(other.features.front().milestone().v_px, feature.first().v_px);
  EXPECT_EQ(other.key_views.front().features, segment.key_views.back().features);
  EXPECT_DOUBLE_EQ(other.key_views.front().s, 0.0);
  EXPECT_DOUBLE_EQ(*other.terrain.slope_rad, -0.05);
  const double length_m = segment.length_m;
  for (const double left_m : {0.5, 2.0, length_m}) {
    EXPECT_NEAR(
        HeadingAt(other.heading, left_m),
        HeadingAt(segment.heading, length_m - left_m) - HeadingAt(segment.heading, length_m), 1e-9);
  }
}

TEST(Backwards, ARouteBeginsWithItsLastSegmentAtHalfTheTaughtSpeed) {
  std::vector<Segment> route{SampleSegment(0, 5), SampleSegment(1, 6), SampleSegment(2, 7)};
  route[1].turn_before_rad = 0.8;
  const auto back = DrivenBackwards(route);
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*back)[i].index.value(), i);
    EXPECT_EQ((*back)[i].features.size(), route[2 - i].features.size());
    EXPECT_TRUE((*back)[i].reverse);
    EXPECT_DOUBLE_EQ((*back)[i].speed_mps(), 0.5 * route[2 - i].speed_mps());
  }
  // A turn to the left before the second segment is a turn to the right after it.
  EXPECT_DOUBLE_EQ((*back)[0].turn_before_rad, 0.0);
  EXPECT_DOUBLE_EQ((*back)[1].turn_before_rad, 0.0);
  EXPECT_DOUBLE_EQ((*back)[2].turn_before_rad, -0.8);
}

TEST(Backwards, PatchesAreAsLargeAsWhatTheyShowIsWhereTheRobotSetsOut) {
  const Segment segment = GrowingSegment(2.0F);
  const auto back = DrivenBackwards({segment});
  ASSERT_TRUE(back);
  EXPECT_EQ(DarkInARow(segment.features.front().patch), 3);
  EXPECT_NEAR(DarkInARow(back->front().features.front().patch), 6, 1);
  const auto same = DrivenBackwards({GrowingSegment(1.0F)});
  ASSERT_TRUE(same);
  EXPECT_EQ(DarkInARow(same->front().features.front().patch), 3);
}

TEST(Backwards, WhatCannotBeDrivenSoIsSaid) {
  const auto shunt = DrivenBackwards({SampleSegment(0, 5), SampleSegmentDrivenBackwards(1, 5)});
  ASSERT_FALSE(shunt);
  EXPECT_THAT(shunt.error().message, HasSubstr("segment 1 was taught driving backwards"));
  Segment blind = SampleSegment(0, 5);
  blind.has_odometry = false;
  const auto without = DrivenBackwards({blind});
  ASSERT_FALSE(without);
  EXPECT_THAT(without.error().message, HasSubstr("segment 0 was taught without odometry"));
}

}  // namespace
}  // namespace trailcast::route
