// How a ROS 2 robot's device stops the robot when something falls silent or fails, or nobody drives
// on with it; how long it waits, and what it says of it.
#include "agent/device/ros2_device.h"
#include "tests/unit/device/ros2_device_fixture.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

TEST_F(Ros2DeviceTest, ADamagedPictureIsLeftOut) {
  run_.topics.odometry = "";
  run_.patience = kSoonTired;
  Open();
  auto next = Next();
  const auto seen = Until(next, [this] {
    GoOn();
    robot_.Say({dds::Ros2Image{.stamp = stamp_,
                               .width_px = 160,
                               .height_px = 120,
                               .encoding = "mono8",
                               .step = 160,
                               .data = {1, 2, 3}}});
  });
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message, HasSubstr("no picture could be read for 1.5 s"));
}

// The camera goes on: what ends is that Next and Drive are called.
TEST_F(Ros2DeviceTest, StopsTheRobotWhenNobodyDrivesOnWithIt) {
  Open();
  ASSERT_TRUE(SaySeen());
  ASSERT_TRUE(DrivesAhead());
  for (milliseconds passed{0}; passed + kCameraFrame <= run_.sensor_timeout;
       passed += kCameraFrame) {
    GoOn();
    Say();
    ASSERT_EQ(robot_.told(), kRos2Ahead) << passed.count();
  }
  GoOn();
  EXPECT_EQ(robot_.told(), kRos2Stand);
  EXPECT_TRUE(told_.empty()) << told_.front().what;
}

TEST_F(Ros2DeviceTest, WhatAnOldPictureLedToIsNotDone) {
  Open();
  ASSERT_TRUE(SaySeen());
  ASSERT_TRUE(DrivesAhead());
  // Until the device says no more that the robot is to stand: nothing else keeps it from driving.
  for (milliseconds passed{0}; passed <= milliseconds(2000); passed += kCameraFrame) {
    GoOn();
    Say();
  }
  EXPECT_EQ(robot_.told(), kRos2Stand) << "the loop that drives hangs";
  ASSERT_TRUE(device_->Drive(kRos2Ahead));
  EXPECT_EQ(robot_.told(), kRos2Stand);
  ASSERT_TRUE(SeeAll(std::nullopt));
  EXPECT_TRUE(DrivesAhead()) << "by a new one";
}

TEST_F(Ros2DeviceTest, SpeedsUpFromStandingAlsoAfterItHadToStop) {
  run_.limits.acceleration_mps2 = 0.5;
  Open();
  const auto told_mps = [&] {
    for (int frame = 0; frame < 2; ++frame) {
      GoOn();
      EXPECT_TRUE(SaySeen());
    }
    EXPECT_TRUE(device_->Drive(kRos2Ahead));
    return robot_.told().linear_mps;
  };
  const double first_mps = told_mps();
  EXPECT_GT(first_mps, 0.0);
  EXPECT_LE(first_mps, 0.05 + 1e-9);
  robot_.Pass(run_.sensor_timeout + milliseconds(1));
  ASSERT_EQ(robot_.told(), kRos2Stand) << "nobody drives on with it";
  const double again_mps = told_mps();
  EXPECT_GT(again_mps, 0.0);
  EXPECT_LE(again_mps, 0.05 + 1e-9);
}

TEST_F(Ros2DeviceTest, StopsTheRobotWhenTheCameraIsSilentAndGoesOnWhenItIsBack) {
  Open();
  ASSERT_TRUE(SaySeen());
  ASSERT_TRUE(DrivesAhead());
  auto next = Next();
  for (milliseconds passed{0}; passed <= run_.sensor_timeout; passed += kCameraFrame) {
    ASSERT_EQ(robot_.told(), kRos2Ahead) << passed.count();
    GoOn();
    SayOdometry();
  }
  EXPECT_EQ(robot_.told(), kRos2Stand);
  EXPECT_FALSE(IsThere(next));
  const SensorTime silent = stamp_;
  const auto seen = Until(next, [this] {
    GoOn();
    Say();
  });
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_GT((*seen)->stamp, silent);
  ASSERT_FALSE(told_.empty());
  EXPECT_THAT(told_, Contains(AllOf(Field(&RobotDevice::Halt::what,
                                          HasSubstr("camera /robot1/image_raw: no picture")),
                                    Field(&RobotDevice::Halt::fault, true))));
  EXPECT_EQ(told_.back().what, "");
}

TEST_F(Ros2DeviceTest, StandsWhereTwoPublishWhatItHearsAndGoesOnWhenOneIsGone) {
  Open();
  ASSERT_TRUE(SaySeen());
  ASSERT_TRUE(DrivesAhead());
  robot_.Crowd("/robot1/odom");
  auto next = Next();
  for (int frame = 0; frame < 3; ++frame) {
    GoOn();
    Say();
  }
  EXPECT_EQ(robot_.told(), kRos2Stand);
  EXPECT_THAT(device_->Ailment(), AllOf(HasSubstr("several publish /robot1/odom"),
                                        HasSubstr("a namespace of its own")));
  const auto is_said = [](const RobotDevice::Halt& halt) {
    return halt.what.find("several publish") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(told_.begin(), told_.end(), is_said), 1) << "said once";
  robot_.Crowd("");
  const auto seen = Until(next, [this] {
    GoOn();
    Say();
  });
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_TRUE(DrivesAhead());
}

TEST_F(Ros2DeviceTest, GivesUpWhenTheCameraStaysSilent) {
  run_.patience = kSoonTired;
  Open();
  ASSERT_TRUE(SaySeen());
  auto next = Next();
  const auto seen = Until(next, [this] {
    GoOn();
    SayOdometry();
  });
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message,
              AllOf(HasSubstr("camera /robot1/image_raw: no picture for 0.3 s"),
                    HasSubstr("not within 1.5 s")));
}

TEST_F(Ros2DeviceTest, StopsTheRobotWhenTheScannerIsSilent) {
  run_.patience = kSoonTired;
  OpenWithAScanner();
  ASSERT_TRUE(DrivesAhead());
  auto failure = Failure();
  EXPECT_THAT(
      Until(failure,
            [this] {
              GoOn();
              Say();
            }),
      AllOf(HasSubstr("scan /robot1/scan: no scan for 0.3 s"), HasSubstr("not within 1.5 s")));
  EXPECT_THAT(
      told_, Contains(AllOf(Field(&RobotDevice::Halt::what, "scan /robot1/scan: no scan for 0.3 s"),
                            Field(&RobotDevice::Halt::fault, true))));
}

TEST_F(Ros2DeviceTest, StopsTheRobotWhenARangeSensorIsSilent) {
  run_.patience = kSoonTired;
  run_.topics.ranges = {"sonar"};
  Open();
  ASSERT_TRUE(SeeAll(std::nullopt));
  auto failure = Failure();
  EXPECT_THAT(Until(failure,
                    [this] {
                      GoOn();
                      Say();
                    }),
              HasSubstr("range /robot1/sonar: no range for 0.3 s"));
}

TEST_F(Ros2DeviceTest, ARangeSensorThatIsNotThereIsNamed) {
  run_.patience = kSoonTired;
  run_.topics.ranges = {"sonar"};
  rangers_ = 0;
  Open();
  auto next = Next();
  const auto seen = Until(next, [this] {
    GoOn();
    Say();
  });
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message, HasSubstr("nobody publishes /robot1/sonar"));
}

TEST_F(Ros2DeviceTest, WithAScanTopicItDoesNotDriveBeforeTheFirstScan) {
  run_.patience = kSoonTired;
  run_.topics.scan = "scan";
  Open();
  auto next = Next();
  const auto seen = Until(next, [this] {
    GoOn();
    Say();
  });
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message, HasSubstr("no scan that can be one came on /robot1/scan"));
}

TEST_F(Ros2DeviceTest, NeedsOdometryUnlessToldThatThereIsNone) {
  run_.patience = kSoonTired;
  Open();
  auto next = Next();
  const auto seen = Until(next, [this] {
    Say(false);
    GoOn();
  });
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message, HasSubstr("no odometry came on /robot1/odom"));
}

TEST_F(Ros2DeviceTest, SaysWhyOdometryThatComesIsNone) {
  run_.patience = kSoonTired;
  Open();
  dds::Ros2Driver::Peers peers;
  peers.cameras = peers.odometers = peers.bases = 1;
  peers.unfit_odometry = "the orientation in it is none";
  robot_.Meet(peers);
  auto next = Next();
  const auto seen = Until(next, [this] {
    Say(false);
    GoOn();
  });
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message,
              AllOf(HasSubstr("/robot1/odom"), HasSubstr("the orientation in it is none")));
}

TEST_F(Ros2DeviceTest, WaitsForASilentRobotOnlyUntilItIsToldToEnd) {
  Open();
  ASSERT_TRUE(SaySeen());
  auto next = Next();
  ASSERT_FALSE(IsThere(next));
  end_ = true;
  const auto end = next.get();
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_FALSE(*end);
}

// No time passes: neither the loop that drives is what stops it, nor silence.
TEST_F(Ros2DeviceTest, ThatHearsTheRobotNoMoreForAFaultStopsItAtOnceAndSaysWhy) {
  Open();
  ASSERT_TRUE(SaySeen());
  ASSERT_TRUE(DrivesAhead());
  robot_.Fail("a message of no known kind");
  ASSERT_TRUE(test::Await([this] { return robot_.told() == kRos2Stand; }, "a stop"));
  ASSERT_TRUE(device_->Drive(kRos2Ahead));
  EXPECT_EQ(robot_.told(), kRos2Stand) << "for good";
  const auto next = device_->Next();
  ASSERT_FALSE(next);
  EXPECT_EQ(next.error().code, ErrorCode::kInternal);
  EXPECT_THAT(next.error().message, AllOf(HasSubstr("the thread that hears the robot has failed"),
                                          HasSubstr("a message of no known kind")));
  EXPECT_EQ(device_->Ailment(), next.error().message);
}

}  // namespace
}  // namespace trailcast::agent
