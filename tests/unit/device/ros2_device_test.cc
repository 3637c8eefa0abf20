// These test what a ROS 2 robot's device gives of what the robot senses, by which stamps, and
// lockstep.
#include "agent/device/ros2_device.h"

#include "tests/unit/device/ros2_device_fixture.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

TEST_F(Ros2DeviceTest, AFrameComesWithWhatTheImuSaidSinceTheOneBefore) {
  run_.topics.imu = "imu";
  Open();
  ASSERT_TRUE(SaySeen());
  GoOn();
  for (int i = 0; i < 4; ++i) SayImu(0.1);
  const auto seen = SaySeen();
  ASSERT_TRUE(seen) << seen.error().message;
  ASSERT_EQ((*seen)->imu.size(), 4U);
  EXPECT_NEAR(motion::Climb((*seen)->imu.front().attitude.value()).value(), 0.1, 1e-9);
}

TEST_F(Ros2DeviceTest, GivesEachFrameOnceHoweverOftenItIsSaid) {
  Open();
  ASSERT_TRUE(SaySeen());
  auto next = Next();
  for (int i = 0; i < 5; ++i) {
    Say();
    EXPECT_FALSE(IsThere(next));
  }
  GoOn();
  EXPECT_EQ(Until(next, [this] { Say(); }).value()->stamp, stamp_);
}

// Which brakes at what is old by its own clock.
TEST_F(Ros2DeviceTest, StampsCommandsByTheBasesClock) {
  odometry_lag_ = std::chrono::hours(1);
  Open();
  ASSERT_TRUE(SaySeen());
  ASSERT_TRUE(DrivesAhead());
  EXPECT_EQ(robot_.latest().stamp, stamp_ - odometry_lag_);
}

TEST_F(Ros2DeviceTest, TakesTheNewestOdometryWhereItLagsBehindAFastCamera) {
  odometry_lag_ = milliseconds(100);
  Open();
  ExpectFramesAtFullRate();
}

TEST_F(Ros2DeviceTest, TakesTheNewestOdometryOfAnotherClock) {
  odometry_lag_ = std::chrono::hours(1);
  Open();
  ExpectFramesAtFullRate();
}

TEST_F(Ros2DeviceTest, OdometryThatIsOnlyRepeatedIsNone) {
  run_.patience = kSoonTired;
  Open();
  ASSERT_TRUE(SaySeen());
  auto failure = Failure();
  const SensorTime stands = stamp_;
  EXPECT_THAT(Until(failure,
                    [&] {
                      GoOn(0.0);
                      odometry_lag_ = stamp_ - stands;
                      Say();
                    }),
              HasSubstr("no odometry for 0.3 s: it comes, but its stamps do not"));
}

TEST_F(Ros2DeviceTest, ARobotWithoutOdometryIsDrivenByVisionAlone) {
  run_.topics.odometry = "";
  Open();
  const auto seen = SaySeen(false);
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_FALSE((*seen)->odometry);
  EXPECT_TRUE(DrivesAhead());
}

TEST_F(Ros2DeviceTest, ADriveIsOverWhenTheRobotStandsAfterItHasMoved) {
  run_.still_at_end = milliseconds(150);
  Open();
  for (int i = 0; i < 10; ++i) {
    const auto seen = SaySeen();
    ASSERT_TRUE(seen) << seen.error().message;
    ASSERT_TRUE(seen->has_value()) << "it has not moved yet";
    GoOn(0.0);
  }
  for (int i = 0; i < 10; ++i) {
    GoOn(0.05);
    ASSERT_TRUE(SaySeen());
  }
  GoOn(0.05);
  int standing = 0;
  for (; standing < 20; ++standing) {
    const auto seen = SaySeen();
    ASSERT_TRUE(seen) << seen.error().message;
    if (!seen->has_value()) break;
    GoOn(0.0);
  }
  EXPECT_EQ(standing, 5);
}

TEST_F(Ros2DeviceTest, WithoutOdometryADriveIsOverWhenThePictureStandsAfterItHasMoved) {
  run_.topics.odometry = "";
  run_.still_at_end = milliseconds(150);
  Open();
  for (int i = 0; i < 10; ++i) {
    const auto seen = SaySeen(false);
    ASSERT_TRUE(seen) << seen.error().message;
    ASSERT_TRUE(seen->has_value()) << "it has not moved yet";
    robot_.Pass(kCameraFrame);
    stamp_ += kCameraFrame;
  }
  for (int i = 0; i < 10; ++i) {
    GoOn();
    const auto seen = SaySeen(false);
    ASSERT_TRUE(seen) << seen.error().message;
    ASSERT_TRUE(seen->has_value()) << "it moves";
  }
  int standing = 0;
  for (; standing < 20; ++standing) {
    robot_.Pass(kCameraFrame);
    stamp_ += kCameraFrame;
    const auto seen = SaySeen(false);
    ASSERT_TRUE(seen) << seen.error().message;
    if (!seen->has_value()) break;
  }
  EXPECT_GE(standing, 3);
  EXPECT_LE(standing, 10);
}

TEST_F(Ros2DeviceTest, GoesOnWhereACamerasClockGoesBackOrStandsStill) {
  Open();
  auto seen = SaySeen();
  ASSERT_TRUE(seen) << seen.error().message;
  SensorTime before = (*seen)->stamp;
  const auto expect_later = [&] {
    seen = SaySeen();
    ASSERT_TRUE(seen) << seen.error().message;
    EXPECT_GT((*seen)->stamp, before);
    EXPECT_LT((*seen)->stamp, before + std::chrono::seconds(20));
    before = (*seen)->stamp;
  };
  stamp_ -= std::chrono::seconds(100);
  odometry_lag_ = std::chrono::seconds(-100);  // which keeps its clock
  GoOn();
  expect_later();
  GoOn();
  expect_later();
  for (int i = 0; i < 3; ++i) {
    GoOn();
    stamp_ -= kCameraFrame;
    odometry_lag_ -= kCameraFrame;
    expect_later();
  }
}

TEST_F(Ros2DeviceTest, OdometryWhoseStampsStandStillCountsAsItComes) {
  Open();
  ASSERT_TRUE(SaySeen());
  const SensorTime stands = stamp_;
  for (int i = 0; i < 20; ++i) {
    GoOn();
    odometry_lag_ = stamp_ - stands;
    const auto seen = SaySeen();
    ASSERT_TRUE(seen) << seen.error().message;
  }
}

TEST_F(Ros2DeviceTest, OdometryThatIsSetToZeroIsNoMotion) {
  Open();
  auto seen = SaySeen();
  ASSERT_TRUE(seen) << seen.error().message;
  const motion::Pose2 before = *(*seen)->odometry;
  pose_ = {0.0, 0.0, 0.0};
  GoOn(0.0);
  seen = SaySeen();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_NEAR(motion::IncrementBetween(before, *(*seen)->odometry).distance_m, 0.0, 1e-9);
  GoOn(0.01);
  const motion::Pose2 there = *(*seen)->odometry;
  seen = SaySeen();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_NEAR(motion::IncrementBetween(there, *(*seen)->odometry).distance_m, 0.01, 1e-9);
}

TEST_F(Ros2DeviceTest, InLockstepAnswersWithTheFramesStamp) {
  run_.lockstep = true;
  Open();
  ASSERT_TRUE(SaySeen());
  ASSERT_TRUE(DrivesAhead());
  EXPECT_EQ(robot_.latest().stamp, stamp_);
}

TEST_F(Ros2DeviceTest, InLockstepAnswersEachFrameOnceMoreWhenItIsSaidAgain) {
  run_.lockstep = true;
  Open();
  ASSERT_TRUE(SaySeen());
  ASSERT_TRUE(DrivesAhead());
  const int before = robot_.commands();
  Say();
  EXPECT_EQ(robot_.commands(), before + 1);
  EXPECT_EQ(robot_.told(), kRos2Ahead);
  EXPECT_EQ(robot_.latest().stamp, stamp_);
}

// A follower's robot does this while its route is still to come.
TEST_F(Ros2DeviceTest, InLockstepAFrameSaidAgainBeforeItIsTakenKeepsItsTime) {
  run_.lockstep = true;
  Open();
  for (int i = 0; i < 30; ++i) {
    Say();
    robot_.Pass(milliseconds(10));
  }
  const auto seen = SaySeen();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_EQ((*seen)->stamp, stamp_);
}

TEST_F(Ros2DeviceTest, InLockstepAnswersAlsoWhileTeaching) {
  run_.lockstep = true;
  Open();
  ASSERT_TRUE(SaySeen());
  auto next = Next();
  EXPECT_FALSE(IsThere(next));
  EXPECT_EQ(robot_.commands(), 1);
  EXPECT_EQ(robot_.told(), kRos2Stand);
  EXPECT_EQ(robot_.latest().stamp, stamp_);
  GoOn();
  EXPECT_TRUE(Until(next, [this] { Say(); }));
}

}  // namespace
}  // namespace trailcast::agent
