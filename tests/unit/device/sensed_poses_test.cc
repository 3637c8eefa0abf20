#include "agent/device/sensed_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kSpeed_mps = 0.4;

// A robot that drives straight on: odometry every 20 ms, a frame every 40 ms.
class SensedPosesTest : public testing::Test {
 protected:
  // Its true place at a moment.
  static double Truth(SensorTime moment) { return kSpeed_mps * Seconds(moment); }
  void Drive(milliseconds duration) {
    for (const SensorTime end = now_ + duration; now_ < end;) {
      now_ += milliseconds(20);
      const auto at = StampClock::Time(
          std::chrono::duration_cast<nanoseconds>(slowness_ * std::chrono::duration<double>(now_)) +
          stood_);
      (void)poses_.AddOdometry(now_ + odometry_clock_, {Truth(now_) + odometry_from_m_, 0.0, 0.0},
                               at + milliseconds(5), {kSpeed_mps, 0.0});
      if (now_ % milliseconds(40) != nanoseconds(0)) continue;
      // The picture of a while ago.
      taken_ = now_ - under_way_;
      frame_ = poses_.AddFrame(taken_ + frame_clock_, at + milliseconds(5));
    }
  }
  // Where odometry has the robot at the last frame, less where it was.
  double Error() { return poses_.At(frame_.value()).x_m - Truth(taken_); }

  SensedPoses poses_{GateOptions{}};
  SensorTime now_ = seconds(1000);
  SensorTime odometry_clock_{0};
  SensorTime frame_clock_{0};
  milliseconds under_way_{0};
  double slowness_ = 1.0;  // seconds in which a second passes there
  nanoseconds stood_{0};   // its clock, so far
  double odometry_from_m_ = 0.0;
  SensorTime taken_{};
  std::optional<SensorTime> frame_;
};

TEST_F(SensedPosesTest, FindsThePlaceOfAFrameHoweverLongItWasUnderWay) {
  for (const milliseconds under_way : {milliseconds(0), milliseconds(60), milliseconds(200)}) {
    under_way_ = under_way;
    Drive(seconds(5));
    EXPECT_NEAR(Error(), 0.0, 1e-6);
  }
  EXPECT_THAT(poses_.TakeNews(), IsEmpty());
}

TEST_F(SensedPosesTest, ASimulatorsClockThatIsSlowIsOneClockAllTheSame) {
  slowness_ = 3.0;
  Drive(seconds(10));
  EXPECT_NEAR(Error(), 0.0, 1e-6);
  EXPECT_THAT(poses_.TakeNews(), IsEmpty());
}

// After its first picture and the odometry of that moment.
TEST_F(SensedPosesTest, ASimulatorsClockThatStoodIsOneClockAllTheSame) {
  now_ += milliseconds(20);
  Drive(milliseconds(20));
  ASSERT_TRUE(frame_);
  stood_ = seconds(4);
  Drive(seconds(2));
  EXPECT_NEAR(Error(), 0.0, 1e-6);
  EXPECT_THAT(poses_.TakeNews(), IsEmpty());
}

TEST_F(SensedPosesTest, ClocksThatAreOneAreNotCompared) {
  poses_ = SensedPoses(GateOptions{}, SensedPoses::Clocks::kOne);
  under_way_ = milliseconds(1500);
  Drive(seconds(5));
  EXPECT_NEAR(Error(), 0.0, 1e-6);
  EXPECT_THAT(poses_.TakeNews(), IsEmpty());
}

TEST_F(SensedPosesTest, EstimatesHowFarTheClocksAreApartAndTells) {
  for (const milliseconds apart :
       {milliseconds(1500), milliseconds(-1500), milliseconds(3'600'000)}) {
    poses_ = SensedPoses(GateOptions{});
    frame_clock_ = apart;
    Drive(seconds(2));
    EXPECT_NEAR(Error(), 0.0, 0.005) << apart.count();
    EXPECT_THAT(poses_.TakeNews(), Contains(HasSubstr("different clocks")));
  }
}

TEST_F(SensedPosesTest, FindsThePlaceAfterEitherClockWasSet) {
  Drive(seconds(2));
  frame_clock_ = -seconds(100);
  Drive(seconds(2));
  EXPECT_NEAR(Error(), 0.0, 0.01);
  odometry_clock_ = -seconds(10);
  Drive(seconds(2));
  EXPECT_NEAR(Error(), 0.0, 0.01);
  const auto news = poses_.TakeNews();
  EXPECT_THAT(news, Contains(HasSubstr("pictures: its clock went back")));
  EXPECT_THAT(news, Contains(HasSubstr("odometry: its clock went back")));
}

TEST_F(SensedPosesTest, OverAJumpTellsHowFarTheRobotMayHaveDriven) {
  Drive(seconds(2));
  EXPECT_EQ(poses_.TakeUnknown().distance_m, 0.0);
  odometry_from_m_ = -2.5;
  Drive(seconds(1));
  EXPECT_NEAR(Error(), 0.0, 0.01);
  EXPECT_NEAR(poses_.TakeUnknown().distance_m, kSpeed_mps * 0.02, 1e-6);
  EXPECT_EQ(poses_.TakeUnknown().distance_m, 0.0);
  EXPECT_THAT(poses_.TakeNews(), Contains(HasSubstr("odometry jumped by 2.4")));
}

TEST_F(SensedPosesTest, WhatIsOnlyRepeatedSaysNothingNew) {
  const auto at = [&](int i) { return StampClock::Time(now_ + i * milliseconds(20)); };
  EXPECT_TRUE(poses_.AddOdometry(now_, {}, at(0), {}));
  EXPECT_FALSE(poses_.AddOdometry(now_, {}, at(1), {}));
  EXPECT_TRUE(poses_.AddOdometry(now_, {0.01, 0.0, 0.0}, at(2), {})) << "only its stamp stands";
  EXPECT_TRUE(poses_.AddOdometry(now_, {0.01, 0.0, 0.0}, at(3), {})) << "it is known to stand";
}

}  // namespace
}  // namespace trailcast::agent
