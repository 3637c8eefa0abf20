#include "agent/device/odometry_gate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trailcast::agent {
namespace {

constexpr double kPeriod_s = 0.02;

// A base that drives a bend, at fifty samples a second.
class OdometryGateTest : public testing::Test {
 protected:
  OdometryGate::Passed Drive(double metres = 0.01, double radians = 0.002,
                             double seconds = kPeriod_s) {
    now_ += FromSeconds(seconds);
    raw_ = motion::Advance(raw_, {metres, radians});
    true_ = motion::Advance(true_, {metres, radians});
    return gate_.Pass(now_, raw_);
  }
  void ExpectTrue(const motion::Pose2& pose) const {
    EXPECT_NEAR(pose.x_m, true_.x_m, 1e-6);
    EXPECT_NEAR(pose.y_m, true_.y_m, 1e-6);
    EXPECT_NEAR(std::remainder(pose.heading_rad - true_.heading_rad, 2.0 * M_PI), 0.0, 1e-6);
  }

  OdometryGate gate_{{}};
  SensorTime now_ = std::chrono::seconds(100);
  motion::Pose2 raw_{3.0, -2.0, 2.5};
  motion::Pose2 true_ = raw_;
};

TEST_F(OdometryGateTest, LetsPassWhatABaseCanDrive) {
  for (int i = 0; i < 100; ++i) {
    const auto passed = Drive(0.05, 0.1);
    EXPECT_FALSE(passed.jump);
    ExpectTrue(passed.pose);
  }
  EXPECT_FALSE(Drive(1.0, 0.5, 0.5).jump) << "after a silence";
}

TEST_F(OdometryGateTest, AJumpIsNoMotionAndWhatComesAfterItGoesOn) {
  for (const motion::Pose2& jump :
       {motion::Pose2{}, motion::Pose2{3.0, -2.0, -2.0}, motion::Pose2{3.3, -2.0, -2.0}}) {
    for (int i = 0; i < 50; ++i) (void)Drive();
    raw_ = jump;
    now_ += FromSeconds(kPeriod_s);
    const auto passed = gate_.Pass(now_, raw_);
    ASSERT_TRUE(passed.jump);
    EXPECT_NEAR(Seconds(passed.jump->gap), kPeriod_s, 1e-9);
    ExpectTrue(passed.pose);
    for (int i = 0; i < 50; ++i) ExpectTrue(Drive().pose);
  }
}

TEST_F(OdometryGateTest, ABaseThatWasStartedAnewHasNotDrivenHomeMeanwhile) {
  for (int i = 0; i < 50; ++i) (void)Drive();
  raw_ = {};
  now_ += std::chrono::seconds(8);
  const auto passed = gate_.Pass(now_, raw_);
  ASSERT_TRUE(passed.jump);
  EXPECT_NEAR(Seconds(passed.jump->gap), 8.0, 1e-9);
  ExpectTrue(passed.pose);
}

}  // namespace
}  // namespace trailcast::agent
