#include "services/lab/simulated/robot_electronics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using Kind = RobotFault::Kind;

const RobotElectronics::Time kStart{std::chrono::seconds(100)};
const motion::VelocityCommand kAhead{0.4, 0.0};
const motion::VelocityCommand kStand{};

RobotElectronics::Picture PictureAt(milliseconds stamp, std::uint8_t gray = 0) {
  RobotElectronics::Picture picture;
  picture.stamp = stamp;
  picture.image.width = picture.image.height = 1;
  picture.image.pixels = {gray};
  return picture;
}

TEST(RobotElectronics, ObeysABasesDelayLaterAndNoCommandForLong) {
  RobotTiming timing;
  timing.base_delay_s = 0.2;
  RobotElectronics robot(timing, {}, 1);
  EXPECT_EQ(robot.Obey(kStart), kStand) << "nobody has said anything";
  robot.Hear(kStart, kAhead);
  EXPECT_EQ(robot.Obey(kStart + milliseconds(199)), kStand);
  EXPECT_EQ(robot.Obey(kStart + milliseconds(200)), kAhead);
  EXPECT_EQ(robot.Obey(kStart + milliseconds(700)), kAhead);
  EXPECT_EQ(robot.Obey(kStart + milliseconds(701)), kStand) << "too old";
  robot.Hear(kStart + milliseconds(800), kAhead);
  robot.Hear(kStart + milliseconds(850), kStand);
  EXPECT_EQ(robot.Obey(kStart + milliseconds(1000)), kAhead);
  EXPECT_EQ(robot.Obey(kStart + milliseconds(1050)), kStand);
}

TEST(RobotElectronics, ACameraIsSlowerThanItsBaseAndLosesPictures) {
  RobotTiming timing;
  timing.picture_rate_hz = 10.0;
  RobotElectronics slow(timing, {}, 1);
  int taken = 0;
  for (int step = 0; step < 300; ++step) taken += slow.TakesPicture() ? 1 : 0;
  EXPECT_NEAR(taken, 100, 1);
  timing.dropped = 0.2;
  RobotElectronics lossy(timing, {}, 1);
  taken = 0;
  for (int step = 0; step < 3000; ++step) taken += lossy.TakesPicture() ? 1 : 0;
  EXPECT_NEAR(taken, 800, 60);
}

TEST(RobotElectronics, PicturesAreSaidLateWithStampsThatAreOff) {
  RobotTiming timing;
  timing.picture_delay_s = 0.15;
  timing.stamps_late_s = 2.0;
  RobotElectronics robot(timing, {}, 1);
  robot.Take(kStart, PictureAt(milliseconds(50)));
  EXPECT_FALSE(robot.Due(kStart + milliseconds(149)));
  const auto picture = robot.Due(kStart + milliseconds(150));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->stamp, SensorTime(milliseconds(2050)));
  EXPECT_FALSE(robot.Due(kStart + milliseconds(150))) << "it is said once";
}

TEST(RobotElectronics, OdometryBeginsAnewAtZero) {
  RobotElectronics robot({}, {{Kind::kOdometryRestarts, {1.0}}}, 1);
  robot.Hear(kStart, kAhead);
  EXPECT_THAT(robot.Advance(kStart), ElementsAre());
  EXPECT_EQ(robot.Say(milliseconds(0), {3.0, 1.0, 0.0})->pose.x_m, 3.0);
  EXPECT_THAT(robot.Advance(kStart + milliseconds(1001)), ElementsAre("odometry-restarts"));
  const auto said = robot.Say(milliseconds(30), {3.5, 1.0, 0.0});
  EXPECT_NEAR(said->pose.x_m, 0.5, 1e-12);
  EXPECT_NEAR(said->pose.y_m, 0.0, 1e-12);
}

TEST(RobotElectronics, WhatFallsSilentSaysNothingUntilItIsOver) {
  RobotElectronics robot({}, {{Kind::kOdometryStops, {1.0, 1.0}}, {Kind::kCameraStops, {1.0, 1.0}}},
                         1);
  robot.Hear(kStart, kAhead);
  (void)robot.Advance(kStart + milliseconds(1500));
  EXPECT_FALSE(robot.Say(milliseconds(0), {}));
  robot.Take(kStart, PictureAt(milliseconds(0)));
  EXPECT_FALSE(robot.Due(kStart + milliseconds(1500)));
  (void)robot.Advance(kStart + milliseconds(2500));
  EXPECT_TRUE(robot.Say(milliseconds(0), {}));
  robot.Take(kStart, PictureAt(milliseconds(30)));
  EXPECT_TRUE(robot.Due(kStart + milliseconds(2500)));
}

TEST(RobotElectronics, AFrozenCameraSaysOnePictureWithNewStamps) {
  RobotElectronics robot({}, {{Kind::kCameraFreezes, {1.0}}}, 1);
  robot.Hear(kStart, kAhead);
  (void)robot.Advance(kStart + milliseconds(1500));
  robot.Take(kStart, PictureAt(milliseconds(10), 7));
  robot.Take(kStart, PictureAt(milliseconds(20), 8));
  (void)robot.Due(kStart);
  const auto picture = robot.Due(kStart);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->stamp, SensorTime(milliseconds(20)));
  EXPECT_EQ(picture->image.pixels.front(), 7);
}

TEST(RobotElectronics, AWheelSlipsAndABaseStands) {
  RobotElectronics robot({}, {{Kind::kWheelSlips, {1.0, 1.0}}, {Kind::kBaseStops, {3.0, 1.0}}}, 1);
  robot.Hear(kStart, kAhead);
  (void)robot.Advance(kStart);
  EXPECT_EQ(robot.grip(), 1.0);
  (void)robot.Advance(kStart + milliseconds(1500));
  EXPECT_LT(robot.grip(), 0.5);
  (void)robot.Advance(kStart + milliseconds(3500));
  EXPECT_EQ(robot.grip(), 1.0);
  robot.Hear(kStart + milliseconds(3500), kAhead);
  EXPECT_EQ(robot.Obey(kStart + milliseconds(3500)), kStand);
}

}  // namespace
}  // namespace trailcast::agent
