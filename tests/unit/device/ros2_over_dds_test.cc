// A robot's device and a ROS 2 robot on the loopback interface: all else of the device is tested by
// a clock that stands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/unique_tag.h"
#include "tests/unit/device/ros2_device_fixture.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;

class Ros2DeviceOverDdsTest : public testing::Test {
 protected:
  Ros2DeviceOverDdsTest() {
    run_.topics.robot = "/robot1";
    run_.topics.discovery_tag = test::UniqueTag();
    run_.topics.network_interface = "lo";
    run_.patience = run_.sensor_timeout = test::kLongEnough;
    run_.limits.acceleration_mps2 = 1000.0;
  }

  void Open() {
    device_ = Ros2Device::Open(run_).value();
    robot_ = dds::Ros2Robot::Open(run_.topics).value();
    ASSERT_TRUE(test::Await(
        [this] {
          (void)robot_->Take(milliseconds(5));
          return robot_->watched();
        },
        "somebody who looks at the robot's pictures"));
  }
  // Says it again until the device has it: samples to a reader that is just being matched get lost.
  Result<std::optional<Observation>> SayUntilSeen() {
    auto next = std::async(std::launch::async, [this] { return device_->Next(); });
    test::Await(
        [&] {
          if (next.wait_for(milliseconds(20)) == std::future_status::ready) return true;
          EXPECT_TRUE(robot_->Publish(dds::Ros2Odometry{kStamp, {3.0, -2.0, 2.5}}));
          EXPECT_TRUE(robot_->Publish(WalkPicture(kStamp, 0)));
          return false;
        },
        "what the device makes of it");
    return next.get();
  }

  static constexpr SensorTime kStamp = std::chrono::seconds(1'700'000'000) + milliseconds(250);
  Ros2Run run_;
  std::unique_ptr<Ros2Device> device_;
  std::unique_ptr<dds::Ros2Robot> robot_;
};

TEST_F(Ros2DeviceOverDdsTest, GivesWhatTheRobotSees) {
  Open();
  const auto seen = SayUntilSeen();
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_EQ((*seen)->stamp, kStamp);
  EXPECT_EQ((*seen)->image.pixels, test::WalkFrame(0).pixels);
  ASSERT_TRUE((*seen)->odometry);
  EXPECT_NEAR((*seen)->odometry->x_m, 3.0, 1e-9);
  EXPECT_NEAR((*seen)->odometry->y_m, -2.0, 1e-9);
  EXPECT_NEAR((*seen)->odometry->heading_rad, 2.5, 1e-9);
  EXPECT_EQ(device_->camera(), "camera 160x120");
}

TEST_F(Ros2DeviceOverDdsTest, DrivesABaseThatListensToTwist) {
  run_.topics.command_type = dds::Ros2CommandType::kTwist;
  Open();
  ASSERT_TRUE(SayUntilSeen());
  EXPECT_TRUE(test::Await(
      [this] {
        EXPECT_TRUE(device_->Drive(kRos2Ahead));
        const auto heard = robot_->Take(milliseconds(20));
        return heard && heard->velocity == kRos2Ahead;
      },
      "the command"));
}

TEST_F(Ros2DeviceOverDdsTest, SaysWhoIsMissingWhenThereIsNoRobot) {
  run_.patience = run_.sensor_timeout = milliseconds(300);
  device_ = Ros2Device::Open(run_).value();
  const auto seen = device_->Next();
  ASSERT_FALSE(seen);
  EXPECT_THAT(seen.error().message,
              AllOf(HasSubstr("nobody publishes /robot1/image_raw"), HasSubstr("ROS domain 0")));
}

TEST_F(Ros2DeviceOverDdsTest, RefusesNamesThatAreNoTopics) {
  for (const char* robot : {"robot1", "/robot 1", "/1robot", "/robot1/", "//robot1"}) {
    run_.topics.robot = robot;
    EXPECT_FALSE(Ros2Device::Open(run_)) << robot;
  }
  run_.topics.robot = "/";
  EXPECT_TRUE(Ros2Device::Open(run_));
}

}  // namespace
}  // namespace trailcast::agent
