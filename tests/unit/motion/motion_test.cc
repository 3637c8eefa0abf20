#include "services/motion/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "services/base/angles.h"

namespace trailcast::motion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance = 1e-12;

void ExpectPose(const Pose2& actual, const Pose2& expected, double tolerance = kTolerance) {
  EXPECT_NEAR(actual.x_m, expected.x_m, tolerance);
  EXPECT_NEAR(actual.y_m, expected.y_m, tolerance);
  EXPECT_NEAR(WrapAngle(actual.heading_rad - expected.heading_rad), 0.0, tolerance);
}

// Anywhere in 20 m x 20 m, headed anywhere.
class RandomPoses {
 public:
  Pose2 Next() { return {metres_(random_), metres_(random_), radians_(random_)}; }

 private:
  std::mt19937 random_{20090401};
  std::uniform_real_distribution<double> metres_{-10.0, 10.0};
  std::uniform_real_distribution<double> radians_{-kPi, kPi};
};

TEST(Compose, OneMetreAheadOfARobotFacingLeftIsOneMetreToTheLeft) {
  ExpectPose(Compose({2.0, 3.0, kPi / 2}, {1.0, 0.0, 0.0}), {2.0, 4.0, kPi / 2});
  ExpectPose(Compose({2.0, 3.0, kPi / 2}, {0.0, 1.0, kPi / 4}), {1.0, 3.0, 3 * kPi / 4});
}

TEST(Compose, HeadingStaysWithinHalfATurn) {
  const Pose2 pose = Compose({0.0, 0.0, Radians(170)}, {0.0, 0.0, Radians(20)});
  EXPECT_NEAR(pose.heading_rad, Radians(-170), kTolerance);
}

TEST(Between, WhatIsNorthOfARobotFacingEastLiesToItsLeft) {
  ExpectPose(Between({1.0, 1.0, 0.0}, {1.0, 3.0, kPi / 2}), {0.0, 2.0, kPi / 2});
  ExpectPose(Between({1.0, 1.0, kPi / 2}, {1.0, 3.0, kPi / 2}), {2.0, 0.0, 0.0});
}

TEST(Between, UndoesCompose) {
  RandomPoses poses;
  for (int i = 0; i < 100; ++i) {
    const Pose2 origin = poses.Next();
    const Pose2 local = poses.Next();
    ExpectPose(Between(origin, Compose(origin, local)), local, 1e-9);
  }
}

TEST(IncrementBetween, StraightAheadAndStraightBack) {
  const Pose2 start{1.0, 2.0, kPi / 2};
  const OdometryIncrement ahead = IncrementBetween(start, {1.0, 2.5, kPi / 2});
  EXPECT_NEAR(ahead.distance_m, 0.5, kTolerance);
  EXPECT_NEAR(ahead.heading_change_rad, 0.0, kTolerance);
  const OdometryIncrement back = IncrementBetween(start, {1.0, 1.5, kPi / 2});
  EXPECT_NEAR(back.distance_m, -0.5, kTolerance);
}

TEST(IncrementBetween, MeasuresAlongTheArcNotAcross) {
  // A quarter circle of radius 2 m to the left: from (0, 0) facing x to (2, 2) facing y.
  const OdometryIncrement quarter = IncrementBetween({0, 0, 0}, {2.0, 2.0, kPi / 2});
  EXPECT_NEAR(quarter.distance_m, kPi, kTolerance);
  EXPECT_NEAR(quarter.heading_change_rad, kPi / 2, kTolerance);
}

TEST(IncrementBetween, TurningOnTheSpotCoversNoDistance) {
  const OdometryIncrement turn = IncrementBetween({1, 1, 0.25}, {1, 1, -0.25});
  EXPECT_NEAR(turn.distance_m, 0.0, kTolerance);
  EXPECT_NEAR(turn.heading_change_rad, -0.5, kTolerance);
}

TEST(Advance, FollowsTheArc) {
  ExpectPose(Advance({0, 0, 0}, {kPi, kPi / 2}), {2.0, 2.0, kPi / 2});
  ExpectPose(Advance({0, 0, 0}, {kPi, -kPi / 2}), {2.0, -2.0, -kPi / 2});
  ExpectPose(Advance({0, 0, kPi / 2}, {-3.0, 0.0}), {0.0, -3.0, kPi / 2});
}

TEST(Advance, UndoesIncrementBetweenAlsoInReverse) {
  RandomPoses poses;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> metres(-2.0, 2.0);
  std::uniform_real_distribution<double> radians(-3.0, 3.0);
  for (int i = 0; i < 200; ++i) {
    const Pose2 start = poses.Next();
    const OdometryIncrement driven{metres(random), radians(random)};
    const OdometryIncrement measured = IncrementBetween(start, Advance(start, driven));
    EXPECT_NEAR(measured.distance_m, driven.distance_m, 1e-9);
    EXPECT_NEAR(measured.heading_change_rad, driven.heading_change_rad, 1e-9);
  }
}

TEST(Advance, SmallStepsAddUpToTheWholeCircle) {
  Pose2 pose{1.0, 0.0, kPi / 2};
  for (int i = 0; i < 360; ++i) pose = Advance(pose, {2 * kPi / 360, Radians(1)});
  ExpectPose(pose, {1.0, 0.0, kPi / 2}, 1e-9);
}

TEST(Limit, CutsEachComponentAndKeepsItsSign) {
  const VelocityLimits limits{0.5, 1.0};
  EXPECT_EQ(Limit({0.7, -1.5}, limits), (VelocityCommand{0.5, -1.0}));
  EXPECT_EQ(Limit({-0.7, 0.3}, limits), (VelocityCommand{-0.5, 0.3}));
  EXPECT_EQ(Limit({0.2, 1.0}, limits), (VelocityCommand{0.2, 1.0}));
}

}  // namespace
}  // namespace trailcast::motion
