#include "services/replay/funnel_follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/taught_segment.h"

namespace trailcast::replay {
namespace {

const test::LandmarkScene kFunnelScene = test::LandmarkScene::Corridor(5.0, 16.0, 80, 5);
constexpr double kDt_s = 1.0 / 30.0;

using Ground = std::function<test::Tilt(const motion::Pose2&)>;
const Ground kFlat = [](const motion::Pose2&) { return test::Tilt{}; };

// Humps and slopes that tilt a robot by up to 4 degrees, roll and pitch each in its own rhythm.
Ground Rough(double phase_rad) {
  return [phase_rad](const motion::Pose2& pose) {
    return test::Tilt{0.07 * std::sin(5.0 * pose.x_m + 2.0 * phase_rad),
                      0.07 * std::sin(7.0 * pose.x_m + phase_rad)};
  };
}

// Drives a perfect robot by the follower's commands until the segment ends.
struct Outcome {
  motion::Pose2 end;
  double driven_m = 0.0;
  bool ended = false;
};

Outcome Drive(const test::TaughtRun& run, motion::Pose2 robot, bool with_odometry = true,
              const Ground& ground = kFlat) {
  FunnelFollower follower(320, 1.0);
  follower.Begin(run.segment);
  Outcome outcome;
  motion::OdometryIncrement moved;
  for (int i = 0; i < 600 && !outcome.ended; ++i) {
    FollowInput input{test::Matched(kFunnelScene, run, robot, ground(robot)), std::nullopt};
    if (with_odometry) input.odometry = moved;
    const FollowStep step = follower.Step(input);
    moved = {step.command.linear_mps * kDt_s, step.command.angular_radps * kDt_s};
    robot = motion::Advance(robot, moved);
    outcome.driven_m += moved.distance_m;
    outcome.ended = step.ended;
  }
  outcome.end = robot;
  return outcome;
}

TEST(FunnelFollower, ExactStartEndsNearTheMilestone) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}});
  const Outcome outcome = Drive(run, {});
  ASSERT_TRUE(outcome.ended);
  EXPECT_NEAR(outcome.driven_m, 2.0, 0.5);  // tau makes it fire a little late
  EXPECT_NEAR(outcome.end.y_m, 0.0, 0.02);
}

TEST(FunnelFollower, HeadingErrorIsTakenBack) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}});
  for (const double error_rad : {-0.1, 0.1}) {
    const Outcome outcome = Drive(run, {0.0, 0.0, error_rad});
    ASSERT_TRUE(outcome.ended);
    EXPECT_LT(std::abs(outcome.end.heading_rad), 0.75 * std::abs(error_rad));
  }
}

TEST(FunnelFollower, TaughtTurnIsDriven) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{0.5, 0.0}, {1.0, 0.3}});
  const Outcome outcome = Drive(run, {});
  ASSERT_TRUE(outcome.ended);
  EXPECT_NEAR(outcome.end.heading_rad, 0.3, 0.12);
}

TEST(FunnelFollower, DrivesAtTheTaughtSpeed) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}});
  FunnelFollower follower(320, 1.0);
  follower.Begin(run.segment);
  const FollowStep step =
      follower.Step({test::Matched(kFunnelScene, run, {}), motion::OdometryIncrement{}});
  EXPECT_NEAR(step.command.linear_mps, 0.3, 0.01);
}

TEST(FunnelFollower, RollIsUndoneBeforeComparing) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}});
  FunnelFollower follower(320, 1.0);
  follower.Begin(run.segment);
  const FollowStep step =
      follower.Step({test::Matched(kFunnelScene, run, {1.9, 0.0, 0.0}, {.roll_rad = 0.08}),
                     motion::OdometryIncrement{}});
  EXPECT_NEAR(step.roll_rad, -0.08, 0.02);
  EXPECT_NEAR(step.vision_turn_rad, 0.0, 0.01);
}

TEST(FunnelFollower, PitchAndRollDoNotEndASegmentEarly) {
  for (int taught = 0; taught < 4; ++taught) {
    const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}}, {.tilt = Rough(1.5 * taught)});
    for (int driven = 0; driven < 4; ++driven) {
      const Outcome outcome = Drive(run, {}, /*with_odometry=*/true, Rough(0.7 + 1.5 * driven));
      ASSERT_TRUE(outcome.ended);
      EXPECT_NEAR(outcome.driven_m, 2.2, 0.4) << taught << ", " << driven;
      EXPECT_NEAR(outcome.end.y_m, 0.0, 0.1) << taught << ", " << driven;
    }
  }
}

TEST(FunnelFollower, WhatWasDrivenPastTheMilestoneBelongsToTheNextSegment) {
  const auto first = test::TeachArcs(kFunnelScene, {}, {{1.0, 0.0}});
  auto second = test::TeachArcs(kFunnelScene, first.end, {{1.0, 0.0}});
  second.segment.index = SegmentIndex(1);
  FunnelFollowerOptions options;
  options.transition.median_length = 15;  // delta is half a second old, and so would its peak be
  FunnelFollower follower(320, 1.0, options);
  follower.Begin(first.segment);
  motion::Pose2 robot;
  constexpr motion::OdometryIncrement kStep{0.01, 0.0};
  while (!follower.Step({test::Matched(kFunnelScene, first, robot), kStep}).ended) {
    robot = motion::Advance(robot, kStep);
    ASSERT_LT(robot.x_m, 1.5);
  }
  follower.Begin(second.segment);
  const FollowStep step =
      follower.Step({test::Matched(kFunnelScene, second, robot), motion::OdometryIncrement{}});
  EXPECT_GT(robot.x_m, 1.15);
  EXPECT_NEAR(step.fraction, robot.x_m - 1.0, 0.05);
}

TEST(FunnelFollower, VisionAloneSteersWithoutOdometry) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}});
  FunnelFollower follower(320, 1.0);
  follower.Begin(run.segment);
  const FollowStep step =
      follower.Step({test::Matched(kFunnelScene, run, {1.0, 0.0, 0.1}), std::nullopt});
  EXPECT_GT(step.turn_rad, 0.0);
  EXPECT_EQ(step.turn_rad, step.vision_turn_rad);
  EXPECT_LT(step.command.angular_radps, 0.0);  // right is clockwise
}

TEST(FunnelFollower, WithoutOdometryTheTracksSayWhereItEnds) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}});
  const Outcome outcome = Drive(run, {}, /*with_odometry=*/false);
  ASSERT_TRUE(outcome.ended);
  EXPECT_NEAR(outcome.driven_m, 1.7, 0.25);
}

TEST(FunnelFollower, OdometryAloneHoldsTheTaughtHeadingWithoutFeatures) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{1.0, 0.4}});
  FunnelFollower follower(320, 1.0);
  follower.Begin(run.segment);
  motion::Pose2 robot;
  motion::OdometryIncrement moved;
  for (double driven_m = 0.0; driven_m < 0.99; driven_m += moved.distance_m) {
    const FollowStep step = follower.Step({{}, moved});
    moved = {step.command.linear_mps * kDt_s, step.command.angular_radps * kDt_s};
    robot = motion::Advance(robot, moved);
  }
  EXPECT_NEAR(robot.heading_rad, 0.4, 0.06);
}

TEST(FunnelFollower, CommandStaysWithinTheLimits) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}});
  FunnelFollowerOptions options;
  options.limits = {0.1, 0.05};
  FunnelFollower follower(320, 1.0, options);
  follower.Begin(run.segment);
  const FollowStep step = follower.Step(
      {test::Matched(kFunnelScene, run, {0.0, 0.0, 0.3}), motion::OdometryIncrement{}});
  EXPECT_LE(std::abs(step.command.linear_mps), 0.1);
  EXPECT_LE(std::abs(step.command.angular_radps), 0.05);
}

TEST(FunnelFollower, WithoutOdometryAHandfulOfFeaturesDoesNotEndASegment) {
  const auto run = test::TeachArcs(kFunnelScene, {}, {{2.0, 0.0}});
  const std::size_t stored = run.segment.features.size();
  ASSERT_GE(stored, 21U);
  // At the milestone, as seen by few of the features and by many.
  const auto at_end = test::Matched(kFunnelScene, run, {2.0, 0.0, 0.0});
  for (const bool few : {true, false}) {
    FunnelFollower follower(320, 1.0);
    follower.Begin(run.segment);
    auto seen = at_end;
    if (few) seen.resize(2);
    bool ended = false;
    for (int i = 0; i < 10; ++i) ended = ended || follower.Step({seen, std::nullopt}).ended;
    EXPECT_EQ(ended, !few);
  }
}

}  // namespace
}  // namespace trailcast::replay
