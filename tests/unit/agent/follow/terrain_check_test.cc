#include "agent/follow/terrain_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agent/follow/comfort.h"
#include "services/base/angles.h"

namespace trailcast::agent {
namespace {

using route::Roughness;
using route::Terrain;
using testing::HasSubstr;

constexpr Terrain kFlat{0.001, 0.1, 0.0};
constexpr Terrain kSteep{0.001, 0.1, 0.14};
constexpr Terrain kRough{0.001, 1.2, 0.0};

// Two metres in four seconds.
route::Segment Taught(std::uint32_t index, const Terrain& terrain) {
  route::Segment segment;
  segment.index = SegmentIndex(index);
  segment.has_odometry = true;
  segment.length_m = 2.0;
  segment.duration_s = 4.0;
  segment.terrain = terrain;
  return segment;
}

template <typename Learner>
Learner After(Learner learner, const std::vector<Terrain>& ground) {
  std::uint32_t index = 0;
  for (const Terrain& terrain : ground) learner.Add(Taught(index++, terrain));
  return learner;
}

TEST(TerrainCheckTest, NamesTheFirstSegmentThatIsTooSteepWhereItIsAndTheLimit) {
  const auto check =
      After(TerrainCheck({.slope_rad = Radians(5.0)}), {kFlat, kFlat, kSteep, kSteep, kRough});
  EXPECT_EQ(
      check.Refusal(0.0).value(),
      "this robot cannot drive this route: in segment 2, 4.0 to 6.0 m along the route, it goes "
      "8.0 degrees uphill, and this robot's limit is 5.0 degrees (--max-slope)");
}

TEST(TerrainCheckTest, DownhillCountsLikeUphill) {
  const auto check = After(TerrainCheck({.slope_rad = Radians(5.0)}), {{0.001, 0.1, -0.14}});
  EXPECT_THAT(check.Refusal(0.0).value(), HasSubstr("8.0 degrees downhill"));
}

TEST(TerrainCheckTest, NamesTheSegmentThatIsTooRough) {
  const auto check = After(TerrainCheck({.roughness = Roughness::kUneven}), {kFlat, kRough});
  EXPECT_THAT(check.Refusal(0.0).value(),
              HasSubstr("in segment 1, 2.0 to 4.0 m along the route, the ground is rough (1.20 "
                        "m/s2), and this robot's limit is uneven (--max-roughness)"));
}

TEST(TerrainCheckTest, WithinItsLimitsOrWithoutAnyNothingIsRefused) {
  const std::vector<Terrain> ground{kFlat, kSteep, kRough};
  EXPECT_FALSE(
      After(TerrainCheck({Radians(8.1), Roughness::kRough}), ground).Refusal(0.0).has_value());
  const auto unlimited = After(TerrainCheck({}), ground);
  EXPECT_FALSE(unlimited.any());
  EXPECT_FALSE(unlimited.Refusal(0.0));
}

TEST(TerrainCheckTest, WhatIsBehindARobotThatGoesOnDoesNotMatter) {
  const auto check = After(TerrainCheck({.slope_rad = Radians(5.0)}), {kFlat, kSteep, kFlat});
  EXPECT_TRUE(check.Refusal(3.9));
  EXPECT_FALSE(check.Refusal(4.1));
}

TEST(TerrainCheckTest, SaysWhatIsNotKnownAndRefusesNothingForThat) {
  const auto check =
      After(TerrainCheck({Radians(5.0), Roughness::kUneven}), {kFlat, {0.001, {}, {}}, {}});
  EXPECT_FALSE(check.Refusal(0.0));
  EXPECT_THAT(check.NotKnown().value(),
              HasSubstr("the slope of 2 of 3 segments, the roughness of 1 of 3 segments"));
  EXPECT_FALSE(After(TerrainCheck({}), {Terrain{}}).NotKnown());
}

ReplayStep DrivingAt(double along_m) {
  ReplayStep step;
  step.state = ReplayState::kFollowing;
  step.along_m = along_m;
  step.segment = SegmentIndex(static_cast<std::uint32_t>(along_m / 2.0));
  step.command = {0.5, 0.2};
  return step;
}

TEST(ComfortTest, GoesHalfAsFastOnRoughGroundAndAlongTheSameBend) {
  const auto comfort = After(Comfort(true), {kFlat, kFlat, kFlat, kRough, kFlat});
  const ReplayStep step = comfort.Apply(DrivingAt(7.0));
  EXPECT_NEAR(step.command.linear_mps, 0.25, 1e-9);
  EXPECT_NEAR(step.command.angular_radps, 0.1, 1e-9);
  EXPECT_EQ(comfort.Apply(DrivingAt(8.5)).command.linear_mps, 0.5);
}

TEST(ComfortTest, SlowsDownBeforeItBeginsAndNotLongBefore) {
  const auto comfort = After(Comfort(true), {kFlat, kFlat, kFlat, kRough});
  EXPECT_EQ(comfort.Apply(DrivingAt(3.0)).command.linear_mps, 0.5);
  double before_mps = 0.5;
  for (double along_m = 5.7; along_m < 6.0; along_m += 0.05) {
    const double now_mps = comfort.Apply(DrivingAt(along_m)).command.linear_mps;
    EXPECT_LT(now_mps, before_mps) << along_m;
    before_mps = now_mps;
  }
  EXPECT_NEAR(comfort.Apply(DrivingAt(6.0)).command.linear_mps, 0.25, 1e-9);
}

TEST(ComfortTest, LeavesSlowerRobotsTurnsOnTheSpotAndThoseThatDoNotAskAlone) {
  ReplayStep slow = DrivingAt(7.0);
  slow.command = {0.1, 0.2};
  ReplayStep turn = DrivingAt(7.0);
  turn.command = {0.0, 0.5};
  const std::vector<Terrain> ground{kFlat, kFlat, kFlat, kRough};
  const auto comfort = After(Comfort(true), ground);
  EXPECT_EQ(comfort.Apply(slow).command, slow.command);
  EXPECT_EQ(comfort.Apply(turn).command, turn.command);
  EXPECT_EQ(After(Comfort(false), ground).Apply(DrivingAt(7.0)).command.linear_mps, 0.5);
}

TEST(ComfortTest, OnARouteWithoutOdometryIsSlowFromTheSegmentBeforeOn) {
  Comfort comfort(true);
  for (std::uint32_t index = 0; index < 4; ++index) {
    route::Segment segment = Taught(index, index == 3 ? kRough : kFlat);
    segment.has_odometry = false;
    segment.length_m = 0.0;
    comfort.Add(segment);
  }
  ReplayStep step;
  step.command = {0.4, 0.0};
  step.segment = SegmentIndex(1);
  EXPECT_EQ(comfort.Apply(step).command.linear_mps, 0.4);
  step.segment = SegmentIndex(2);
  EXPECT_NEAR(comfort.Apply(step).command.linear_mps, 0.2, 1e-9);
}

}  // namespace
}  // namespace trailcast::agent
