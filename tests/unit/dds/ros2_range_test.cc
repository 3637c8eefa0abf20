// These test what a range sensor sees, from the robot's end of ROS 2's topic to the driver's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "newer_ros2.h"
#include "ros2.h"
#include "services/dds/ros2_link.h"
#include "services/dds/src/domain/domain_config.h"
#include "services/dds/src/entities.h"
#include "services/dds/src/ros2/ros2_wire.h"
#include "tests/support/await.h"
#include "tests/support/unique_tag.h"

namespace trailcast::dds {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

class Ros2RangeTest : public testing::Test {
 protected:
  Ros2RangeTest() {
    options_.robot = "/robot1";
    options_.ranges = {"sonar_left", "/sonar_right"};
    options_.network_interface = "lo";
    options_.discovery_tag = test::UniqueTag();
    driver_ = Ros2Driver::Open(options_).value();
  }
  // Returns what the driver hears while somebody says it repeatedly.
  template <typename Say>
  std::optional<Ros2Range> HearWhile(const Say& say) {
    std::vector<Ros2Sensed> heard;
    const auto deadline = steady_clock::now() + test::kLongEnough;
    while (heard.empty() && steady_clock::now() < deadline) {
      say();
      heard = driver_->Take(milliseconds(20));
    }
    if (heard.empty() || !std::holds_alternative<Ros2Range>(heard.front())) return std::nullopt;
    return std::get<Ros2Range>(heard.front());
  }

  Ros2Options options_;
  std::unique_ptr<Ros2Driver> driver_;
};

TEST_F(Ros2RangeTest, ComesFromTheRobotAsItWasSeen) {
  EXPECT_EQ(options_.RangeTopic(0), "/robot1/sonar_left");
  EXPECT_EQ(options_.RangeTopic(1), "/sonar_right");
  const auto robot = Ros2Robot::Open(options_).value();
  const Ros2Range said{std::chrono::seconds(12), 1, {0.5, 0.125, 4.0, 1.5F}};
  const auto heard = HearWhile([&] { ASSERT_TRUE(robot->Publish(said)); });
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->stamp, said.stamp);
  EXPECT_EQ(heard->sensor, 1U);
  EXPECT_DOUBLE_EQ(heard->range.field_rad, 0.5);
  EXPECT_DOUBLE_EQ(heard->range.least_m, 0.125);
  EXPECT_DOUBLE_EQ(heard->range.most_m, 4.0);
  EXPECT_EQ(heard->range.range_m, 1.5F);
  EXPECT_THAT(driver_->peers().rangers, testing::ElementsAre(1, 1));
  EXPECT_FALSE(robot->Publish(Ros2Range{{}, 2, {}}));
}

// They say a variance, too.
TEST_F(Ros2RangeTest, ComesFromRobotsWithNewerReleases) {
  DdsOptions dds;
  dds.network_interface = options_.network_interface;
  dds.discovery_tag = options_.discovery_tag;
  const auto domain = Domain::Create(DomainConfig(dds, {}, "").value()).value();
  const auto participant = Participant::Create(domain, "").value();
  dds_topic_descriptor_t type = newer_RangeWithVariance_desc;
  type.m_typename = RangeType().m_typename;
  const auto topic = Topic::Create(participant, type, "rt/sonar_right").value();
  auto writer = Writer::Create(participant, topic, MakeQos()).value();
  std::string frame = "sonar";
  newer_RangeWithVariance wire{{7, 0}, frame.data(), 0, 0.5F, 0.125F, 4.0F, 2.5F, 0.01F};
  const auto heard = HearWhile([&] { ASSERT_TRUE(writer.Write(&wire)); });
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->sensor, 1U);
  EXPECT_EQ(heard->range.range_m, 2.5F);
}

// ROS 2 itself matches the type by this name.
TEST(Ros2Range, IsReadFromRos2sFields) {
  EXPECT_STREQ(RangeType().m_typename, "sensor_msgs::msg::dds_::Range_");
  sensor_msgs_msg_dds__Range_ wire{};
  wire.header.stamp.sec = 3;
  wire.field_of_view = 0.25F;
  wire.min_range = 0.5F;
  wire.max_range = 2.0F;
  wire.range = -std::numeric_limits<float>::infinity();
  const auto range = RangeFromWire(&wire, 4);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->sensor, 4U);
  EXPECT_EQ(range->stamp, std::chrono::seconds(3));
  EXPECT_LT(range->range.range_m, 0.0F);
  wire.field_of_view = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(RangeFromWire(&wire, 4));
}

}  // namespace
}  // namespace trailcast::dds
