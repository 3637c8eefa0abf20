// A scanner's looks, from the robot's end of ROS 2's topic to the driver's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ros2.h"
#include "services/dds/ros2_link.h"
#include "services/dds/src/ros2/ros2_wire.h"
#include "tests/support/await.h"
#include "tests/support/unique_tag.h"

namespace trailcast::dds {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::ElementsAre;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Ros2Scan, ComesFromTheRobotAsItWasSeen) {
  Ros2Options options;
  options.robot = "/robot1";
  options.scan = "scan";
  options.network_interface = "lo";
  options.discovery_tag = test::UniqueTag();
  EXPECT_EQ(options.ScanTopic(), "/robot1/scan");
  const auto driver = Ros2Driver::Open(options).value();
  const auto robot = Ros2Robot::Open(options).value();
  const Ros2Scan said{std::chrono::seconds(12), {-0.5, 0.25, 0.125, 8.0, {1.0F, 2.5F, 3.0F}}};
  std::vector<Ros2Sensed> heard;
  const auto deadline = steady_clock::now() + test::kLongEnough;
  while (heard.empty() && steady_clock::now() < deadline) {
    ASSERT_TRUE(robot->Publish(said));
    heard = driver->Take(milliseconds(20));
  }
  ASSERT_FALSE(heard.empty());
  const auto* scan = std::get_if<Ros2Scan>(&heard.front());
  ASSERT_NE(scan, nullptr);
  EXPECT_EQ(scan->stamp, said.stamp);
  EXPECT_DOUBLE_EQ(scan->scan.first_rad, -0.5);
  EXPECT_DOUBLE_EQ(scan->scan.step_rad, 0.25);
  EXPECT_DOUBLE_EQ(scan->scan.least_m, 0.125);
  EXPECT_DOUBLE_EQ(scan->scan.most_m, 8.0);
  EXPECT_THAT(scan->scan.ranges_m, ElementsAre(1.0F, 2.5F, 3.0F));
  EXPECT_EQ(driver->peers().scanners, 1);
}

TEST(Ros2Scan, ARobotWithoutAScannerSaysNone) {
  Ros2Options options;
  options.robot = "/robot1";
  options.network_interface = "lo";
  options.discovery_tag = test::UniqueTag();
  EXPECT_FALSE(Ros2Robot::Open(options).value()->Publish(Ros2Scan{}));
}

// ROS 2 itself matches the type by this name.
TEST(Ros2Scan, IsReadFromRos2sFields) {
  std::vector<float> ranges{1.0F, kNan};
  sensor_msgs_msg_dds__LaserScan_ wire{};
  wire.angle_min = -1.0F;
  wire.angle_increment = 0.5F;
  wire.range_min = 0.25F;
  wire.range_max = 4.0F;
  wire.ranges._buffer = ranges.data();
  wire.ranges._length = 2;
  const auto scan = ScanFromWire(&wire);
  ASSERT_TRUE(scan);
  EXPECT_DOUBLE_EQ(scan->scan.first_rad, -1.0);
  ASSERT_EQ(scan->scan.ranges_m.size(), 2U);
  EXPECT_TRUE(std::isnan(scan->scan.ranges_m[1]));
  EXPECT_STREQ(ScanType().m_typename, "sensor_msgs::msg::dds_::LaserScan_");

  wire.angle_increment = kNan;
  EXPECT_FALSE(ScanFromWire(&wire));
  wire.angle_increment = 0.5F;
  wire.ranges._length = 0;
  EXPECT_FALSE(ScanFromWire(&wire));
  ranges.resize(motion::kMostRanges + 1);
  wire.angle_increment = 1e-5F;
  wire.ranges._buffer = ranges.data();
  wire.ranges._length = static_cast<std::uint32_t>(ranges.size());
  EXPECT_FALSE(ScanFromWire(&wire));
}

}  // namespace
}  // namespace trailcast::dds
