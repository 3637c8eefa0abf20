#include "services/replay/funnel_lane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/landmark_scene.h"

namespace trailcast::replay {
namespace {

constexpr double kGain = 0.001;  // radians per pixel

TEST(FunnelLane, ConstraintsHoldInsideTheFunnel) {
  EXPECT_TRUE(InsideFunnel({30.0, 50.0}));
  EXPECT_TRUE(InsideFunnel({-30.0, -50.0}));
}

TEST(FunnelLane, ConstraintOneFailsPastTheMilestoneCoordinate) {
  EXPECT_FALSE(InsideFunnel({60.0, 50.0}));
  EXPECT_FALSE(InsideFunnel({-60.0, -50.0}));
}

TEST(FunnelLane, ConstraintTwoFailsOnTheOtherSide) {
  EXPECT_FALSE(InsideFunnel({-10.0, 50.0}));
  EXPECT_FALSE(InsideFunnel({10.0, -50.0}));
}

TEST(FunnelLane, DistanceToTheLineIsHandWorked) {
  EXPECT_DOUBLE_EQ(DistanceToLine({60.0, 50.0}), 10.0 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(DistanceToLine({50.0, 60.0}), -10.0 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(DistanceToLine({5.0, 5.0}), 0.0);
}

TEST(FunnelLane, NoTurnInsideTheFunnel) {
  EXPECT_EQ(FeatureTurn({30.0, 50.0}, kGain), 0.0);
  EXPECT_EQ(FeatureTurn({-30.0, -50.0}, kGain), 0.0);
  EXPECT_EQ(FeatureTurn({50.0, 50.0}, kGain), 0.0);
}

TEST(FunnelLane, TurnsRightByTheDistanceToTheLineWhenTooFarRight) {
  // min(60, 10/sqrt 2) = 7.07 px
  EXPECT_DOUBLE_EQ(FeatureTurn({60.0, 50.0}, kGain), kGain * 10.0 / std::sqrt(2.0));
}

TEST(FunnelLane, TurnIsBoundedByTheCoordinateItself) {
  // On the wrong side: phi = (10 + 50)/sqrt 2 = 42.4, uC = 10 is smaller.
  EXPECT_DOUBLE_EQ(FeatureTurn({10.0, -50.0}, kGain), kGain * 10.0);
}

TEST(FunnelLane, LeftIsTheMirrorOfRight) {
  for (const double u_c : {-90.0, -20.0, 3.0, 40.0, 120.0}) {
    for (const double u_d : {-70.0, -5.0, 8.0, 60.0}) {
      EXPECT_DOUBLE_EQ(FeatureTurn({u_c, u_d}, kGain), -FeatureTurn({-u_c, -u_d}, kGain));
    }
  }
}

TEST(FunnelLane, MeanCountsContentFeaturesToo) {
  const std::vector<FunnelPair> pairs{{60.0, 50.0}, {30.0, 50.0}};
  EXPECT_DOUBLE_EQ(MeanFeatureTurn(pairs, kGain), 0.5 * kGain * 10.0 / std::sqrt(2.0));
  EXPECT_EQ(MeanFeatureTurn({}, kGain), 0.0);
}

TEST(FunnelLane, FusionWeighsVisionByEta) {
  EXPECT_DOUBLE_EQ(FuseTurns(0.2, -0.1, 0.5), 0.05);
  EXPECT_DOUBLE_EQ(FuseTurns(0.2, -0.1, 1.0), 0.2);
}

// The turn that a landmark scene asks of a robot at `robot`, when the milestone was seen at `goal`.
double Asked(const test::LandmarkScene& scene, const motion::Pose2& robot,
             const motion::Pose2& goal) {
  std::vector<FunnelPair> pairs;
  for (const auto& now : scene.Look(robot)) {
    for (const auto& then : scene.Look(goal)) {
      if (now.id == then.id) pairs.push_back({now.u_px, then.u_px});
    }
  }
  EXPECT_GE(pairs.size(), 8U);
  return MeanFeatureTurn(pairs, kGain);
}

TEST(FunnelLane, StraightDriveAtTheGoalAsksForNothing) {
  const auto scene = test::LandmarkScene::Corridor(6.0, 14.0, 60, 1);
  for (double x = 0.0; x < 3.0; x += 0.5) {
    EXPECT_EQ(Asked(scene, {x, 0.0, 0.0}, {3.0, 0.0, 0.0}), 0.0) << "at " << x << " m";
  }
}

TEST(FunnelLane, HeadingToTheLeftAsksForRightAndTheReverse) {
  const auto scene = test::LandmarkScene::Corridor(6.0, 14.0, 60, 1);
  EXPECT_GT(Asked(scene, {1.0, 0.0, 0.1}, {3.0, 0.0, 0.0}), 0.0);
  EXPECT_LT(Asked(scene, {1.0, 0.0, -0.1}, {3.0, 0.0, 0.0}), 0.0);
}

TEST(FunnelLane, BeingLeftOfThePathAsksForRightAndTheReverse) {
  const auto scene = test::LandmarkScene::Corridor(6.0, 14.0, 60, 1);
  EXPECT_GT(Asked(scene, {2.0, 0.5, 0.0}, {3.0, 0.0, 0.0}), 0.0);
  EXPECT_LT(Asked(scene, {2.0, -0.5, 0.0}, {3.0, 0.0, 0.0}), 0.0);
}

TEST(MajorityTurn, GoesWithTheVotesNotWithTheirSize) {
  // One wants far to the left, two a little to the right, one is content.
  const std::vector<FunnelPair> pairs = {{-150.0, -20.0}, {31.0, 30.0}, {52.0, 50.0}, {30.0, 50.0}};
  EXPECT_EQ(MajorityTurn(pairs), 1);
  const std::vector<FunnelPair> mirrored = {
      {150.0, 20.0}, {-31.0, -30.0}, {-52.0, -50.0}, {-30.0, -50.0}};
  EXPECT_EQ(MajorityTurn(mirrored), -1);
}

TEST(MajorityTurn, IsNoneWithoutAMajority) {
  EXPECT_EQ(MajorityTurn({}), 0);
  const std::vector<FunnelPair> split = {{-31.0, -30.0}, {31.0, 30.0}};
  EXPECT_EQ(MajorityTurn(split), 0);
  const std::vector<FunnelPair> content = {{30.0, 50.0}, {20.0, 40.0}};
  EXPECT_EQ(MajorityTurn(content), 0);
}

}  // namespace
}  // namespace trailcast::replay
