// These test what an IMU says, from the robot's end of ROS 2's topic to the driver's.
#include <gtest/gtest.h>

#include <cmath>

#include "ros2.h"
#include "services/dds/ros2_link.h"
#include "services/dds/src/ros2/ros2_wire.h"
#include "tests/support/await.h"
#include "tests/support/unique_tag.h"

namespace trailcast::dds {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

TEST(Ros2ImuTest, ComesFromTheRobotAsItWasFelt) {
  Ros2Options options;
  options.robot = "/robot1";
  options.imu = "imu/data";
  options.network_interface = "lo";
  options.discovery_tag = test::UniqueTag();
  EXPECT_EQ(options.ImuTopic(), "/robot1/imu/data");
  const auto driver = Ros2Driver::Open(options).value();
  const auto robot = Ros2Robot::Open(options).value();
  Ros2Imu said{std::chrono::seconds(12), {}};
  said.felt.acceleration_mps2 = {0.5, -0.25, 9.75};
  said.felt.attitude = motion::Attitude{0.0, 0.6, 0.0, 0.8};
  std::vector<Ros2Sensed> heard;
  const auto deadline = steady_clock::now() + test::kLongEnough;
  while (heard.empty() && steady_clock::now() < deadline) {
    ASSERT_TRUE(robot->Publish(said));
    heard = driver->Take(milliseconds(20));
  }
  ASSERT_FALSE(heard.empty());
  const auto* imu = std::get_if<Ros2Imu>(&heard.front());
  ASSERT_NE(imu, nullptr);
  EXPECT_EQ(imu->stamp, said.stamp);
  EXPECT_EQ(imu->felt.acceleration_mps2, said.felt.acceleration_mps2);
  ASSERT_TRUE(imu->felt.attitude);
  EXPECT_EQ(imu->felt.attitude->y, 0.6);
  EXPECT_EQ(driver->peers().imus, 1);
  EXPECT_TRUE(robot->imu_is_heard());
}

TEST(Ros2ImuTest, ARobotWithoutAnImuSaysNone) {
  Ros2Options options;
  options.robot = "/robot1";
  options.network_interface = "lo";
  options.discovery_tag = test::UniqueTag();
  const auto robot = Ros2Robot::Open(options).value();
  EXPECT_FALSE(robot->Publish(Ros2Imu{}));
  EXPECT_FALSE(robot->imu_is_heard());
}

// ROS 2 itself matches the type by this name.
TEST(Ros2ImuTest, IsReadFromRos2sFields) {
  sensor_msgs_msg_dds__Imu_ wire{};
  wire.orientation.w = 1.0;
  wire.linear_acceleration.z = 9.81;
  const auto both = ImuFromWire(&wire);
  ASSERT_TRUE(both);
  EXPECT_TRUE(both->felt.attitude);
  EXPECT_EQ(both->felt.acceleration_mps2->z(), 9.81);
  EXPECT_STREQ(ImuType().m_typename, "sensor_msgs::msg::dds_::Imu_");

  wire.orientation_covariance[0] = -1.0;
  EXPECT_FALSE(ImuFromWire(&wire)->felt.attitude) << "it is not estimated";
  wire.orientation_covariance[0] = 0.0;
  wire.orientation.w = 0.0;
  EXPECT_FALSE(ImuFromWire(&wire)->felt.attitude) << "zeros are none";
  wire.linear_acceleration.z = std::nan("");
  EXPECT_FALSE(ImuFromWire(&wire)) << "nothing is left";
  wire.linear_acceleration.z = 9.81;
  wire.linear_acceleration_covariance[0] = -1.0;
  EXPECT_FALSE(ImuFromWire(&wire));
}

}  // namespace
}  // namespace trailcast::dds
