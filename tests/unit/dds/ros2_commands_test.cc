// These test what others tell a base, as a program hears it that does not drive the base itself.
#include <gtest/gtest.h>

#include "services/dds/ros2_link.h"
#include "services/dds/src/domain/domain_config.h"
#include "services/dds/src/entities.h"
#include "services/dds/src/ros2/ros2_wire.h"
#include "tests/support/await.h"
#include "tests/support/unique_tag.h"

namespace trailcast::dds {
namespace {

using std::chrono::milliseconds;

class Ros2CommandsTest : public testing::TestWithParam<Ros2CommandType> {
 protected:
  Ros2CommandsTest() {
    options_.robot = "/robot1";
    options_.command_type = GetParam();
    options_.network_interface = "lo";
    options_.discovery_tag = test::UniqueTag();
  }
  std::unique_ptr<Ros2Driver> Driver(bool hears) const {
    Ros2Options options = options_;
    options.hear_commands = hears;
    return Ros2Driver::Open(options).value();
  }

  Ros2Options options_;
};

TEST_P(Ros2CommandsTest, OfOthersAreHeardAndNotItsOwn) {
  const auto listener = Driver(true);
  const auto teleoperator = Driver(false);
  const Ros2Command others{std::chrono::seconds(7), {0.4, -0.2}};
  const Ros2Command own{std::chrono::seconds(8), {0.1, 0.1}};
  std::vector<Ros2Sensed> heard;
  ASSERT_TRUE(test::Await(
      [&] {
        EXPECT_TRUE(listener->Publish(own));
        EXPECT_TRUE(teleoperator->Publish(others));
        for (Ros2Sensed& each : listener->Take(milliseconds(20))) heard.push_back(std::move(each));
        return heard.size() >= 3;
      },
      "commands"));
  for (const Ros2Sensed& each : heard) {
    ASSERT_TRUE(std::holds_alternative<Ros2Command>(each));
    EXPECT_EQ(std::get<Ros2Command>(each).velocity, others.velocity);
  }
}

TEST_P(Ros2CommandsTest, WhoListensToThemIsNoBase) {
  const auto listener = Driver(true);
  const auto robot = Ros2Robot::Open(options_).value();
  ASSERT_TRUE(test::Await([&] { return listener->peers().bases > 0; }, "the base"));
  EXPECT_EQ(listener->peers().bases, 1) << "the robot alone";
}

// A base whose quality of service asks for more than commands are offered with.
TEST_P(Ros2CommandsTest, ABaseThatAsksForMoreIsNamedWithWhat) {
  const auto driver = Driver(false);
  DdsOptions dds;
  dds.domain_id = options_.domain_id;
  dds.discovery_tag = options_.discovery_tag;
  dds.network_interface = options_.network_interface;
  const auto domain = Domain::Create(DomainConfig(dds, {}, "").value()).value();
  const auto participant = Participant::Create(domain, "").value();
  const auto topic =
      Topic::Create(participant, CommandType(GetParam()), "rt" + options_.CommandTopic()).value();
  const Qos qos = MakeQos();
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  const auto base = Reader::Create(participant, topic, qos).value();
  ASSERT_TRUE(test::Await([&] { return !driver->peers().mismatch.empty(); }, "the base"));
  EXPECT_EQ(driver->peers().mismatch, "/robot1/cmd_vel (durability)");
  EXPECT_EQ(driver->peers().bases, 0);
}

INSTANTIATE_TEST_SUITE_P(Types, Ros2CommandsTest,
                         testing::Values(Ros2CommandType::kTwist, Ros2CommandType::kTwistStamped),
                         [](const auto& test) {
                           return test.param == Ros2CommandType::kTwist ? "Twist" : "TwistStamped";
                         });

}  // namespace
}  // namespace trailcast::dds
