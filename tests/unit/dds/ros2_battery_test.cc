// These test what a battery says, from the robot's end of ROS 2's topic to the driver's.
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

class Ros2BatteryTest : public testing::Test {
 protected:
  Ros2BatteryTest() {
    options_.robot = "/robot1";
    options_.battery = "battery_state";
    options_.network_interface = "lo";
    options_.discovery_tag = test::UniqueTag();
    driver_ = Ros2Driver::Open(options_).value();
  }
  // Returns what the driver hears while somebody says it repeatedly.
  template <typename Say>
  std::optional<Ros2Battery> HearWhile(const Say& say) {
    std::vector<Ros2Sensed> heard;
    const auto deadline = steady_clock::now() + test::kLongEnough;
    while (heard.empty() && steady_clock::now() < deadline) {
      say();
      heard = driver_->Take(milliseconds(20));
    }
    if (heard.empty() || !std::holds_alternative<Ros2Battery>(heard.front())) return std::nullopt;
    return std::get<Ros2Battery>(heard.front());
  }

  Ros2Options options_;
  std::unique_ptr<Ros2Driver> driver_;
};

TEST_F(Ros2BatteryTest, ComesFromTheRobotAsItWasSaid) {
  EXPECT_EQ(options_.BatteryTopic(), "/robot1/battery_state");
  const auto robot = Ros2Robot::Open(options_).value();
  const Ros2Battery said{std::chrono::seconds(12), 0.625F, 2.5F, 4.0F};
  const auto heard = HearWhile([&] { ASSERT_TRUE(robot->Publish(said)); });
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->stamp, said.stamp);
  EXPECT_EQ(heard->percentage, 0.625F);
  EXPECT_EQ(heard->charge_ah, 2.5F);
  EXPECT_EQ(heard->capacity_ah, 4.0F);
  EXPECT_EQ(driver_->peers().batteries, 1);
}

// ROS 2 itself says more after what is read here.
TEST_F(Ros2BatteryTest, ComesFromRobotsThatSayMore) {
  DdsOptions dds;
  dds.network_interface = options_.network_interface;
  dds.discovery_tag = options_.discovery_tag;
  const auto domain = Domain::Create(DomainConfig(dds, {}, "").value()).value();
  const auto participant = Participant::Create(domain, "").value();
  dds_topic_descriptor_t type = newer_WholeBatteryState_desc;
  type.m_typename = BatteryType().m_typename;
  const auto topic = Topic::Create(participant, type, "rt/robot1/battery_state").value();
  auto writer = Writer::Create(participant, topic, MakeQos()).value();
  std::string frame = "battery";
  std::string place = "bay";
  std::string number = "42";
  newer_WholeBatteryState wire{};
  wire.sec = 7;
  wire.frame_id = frame.data();
  wire.percentage = std::numeric_limits<float>::quiet_NaN();
  wire.charge = 1.0F;
  wire.capacity = 5.0F;
  wire.location = place.data();
  wire.serial_number = number.data();
  const auto heard = HearWhile([&] { ASSERT_TRUE(writer.Write(&wire)); });
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->stamp, std::chrono::seconds(7));
  EXPECT_NE(heard->percentage, heard->percentage) << "no number";
  EXPECT_EQ(heard->charge_ah, 1.0F);
  EXPECT_EQ(heard->capacity_ah, 5.0F);
}

// ROS 2 itself matches the type by this name.
TEST(Ros2Battery, IsReadFromRos2sFields) {
  EXPECT_STREQ(BatteryType().m_typename, "sensor_msgs::msg::dds_::BatteryState_");
}

TEST(Ros2Battery, HasATopicOnlyWhereThatIsNamed) {
  Ros2Options options;
  options.robot = "/robot1";
  options.battery = "5th";
  EXPECT_FALSE(options.Validate());
  options.battery = "battery_state";
  EXPECT_TRUE(options.Validate());
}

}  // namespace
}  // namespace trailcast::dds
