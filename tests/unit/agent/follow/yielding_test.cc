#include "agent/follow/src/yielding.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

constexpr Yielding::Time kNow{std::chrono::hours(1)};

Neighbour At(double along_m) { return {AgentId("a"), along_m, 0.0, kNow, true}; }

ReplayStep StepAt(double along_m) {
  ReplayStep step;
  step.state = ReplayState::kFollowing;
  step.along_m = along_m;
  step.command = {0.5, 0.2};
  step.segment = SegmentIndex(7);
  step.evidence = Evidence::kFeatures;
  return step;
}

class YieldingTest : public testing::Test {
 protected:
  ReplayStep Apply(const ReplayStep& step, double t_s = 0.0) {
    return yielding_.Apply(step, FromSeconds(t_s), kNow);
  }
  bool StandsOn(double t_s) { return yielding_.StandOn(FromSeconds(t_s), kNow).has_value(); }
  Yielding yielding_{AgentId("b"), {}};
};

TEST_F(YieldingTest, ChangesNothingWithNobodyAhead) {
  const ReplayStep step = Apply(StepAt(5.0));
  EXPECT_EQ(step.command, (motion::VelocityCommand{0.5, 0.2}));
  EXPECT_EQ(step.state, ReplayState::kFollowing);
}

TEST_F(YieldingTest, DrivesTheSameCurveMoreSlowly) {
  yielding_.Hear({At(6.7)});
  const ReplayStep step = Apply(StepAt(5.0));
  EXPECT_GT(step.command.linear_mps, 0.0);
  EXPECT_LT(step.command.linear_mps, 0.5);
  EXPECT_NEAR(step.command.angular_radps / step.command.linear_mps, 0.4, 1e-9);
  EXPECT_EQ(step.state, ReplayState::kFollowing);
}

TEST_F(YieldingTest, StandsAndSaysBehindWhom) {
  yielding_.Hear({At(6.4)});
  const ReplayStep step = Apply(StepAt(5.0));
  EXPECT_EQ(step.command, motion::VelocityCommand{});
  EXPECT_EQ(step.state, ReplayState::kYielding);
  EXPECT_EQ(step.reason, "waits for a, 1.4 m ahead");
  EXPECT_EQ(step.segment, SegmentIndex(7));
  EXPECT_EQ(step.evidence, Evidence::kNothing) << "that carries it";
}

TEST_F(YieldingTest, LooksAtItsPicturesUntilItHasComeToAStandAndAgainWhenItGoesOn) {
  yielding_.Hear({At(6.4)});
  EXPECT_FALSE(StandsOn(0.0));
  (void)Apply(StepAt(5.0), 0.0);
  EXPECT_FALSE(StandsOn(0.5));
  EXPECT_TRUE(StandsOn(1.1));
  EXPECT_TRUE(StandsOn(100.0));
  yielding_.Hear({At(7.4)});
  EXPECT_FALSE(StandsOn(100.1));
  EXPECT_EQ(Apply(StepAt(5.0), 100.1).state, ReplayState::kFollowing);
  EXPECT_FALSE(StandsOn(100.2));
}

TEST_F(YieldingTest, LeavesARobotAloneThatStandsAnyway) {
  yielding_.Hear({At(6.4)});
  ReplayStep covered = StepAt(5.0);
  covered.command = {};
  covered.state = ReplayState::kBlind;
  EXPECT_EQ(Apply(covered).state, ReplayState::kBlind);
  ReplayStep seeking = StepAt(0.0);
  seeking.along_m.reset();
  EXPECT_EQ(Apply(seeking).state, ReplayState::kFollowing) << "nobody knows where it is";
}

TEST_F(YieldingTest, KeepsNoDistanceWhereNoneIsWanted) {
  Yielding off(AgentId("b"), {.distance_m = 0.0});
  off.Hear({At(5.1)});
  EXPECT_EQ(off.Apply(StepAt(5.0), FromSeconds(0.0), kNow).command.linear_mps, 0.5);
}

}  // namespace
}  // namespace trailcast::agent
