#include "services/dds/src/ros2/closed_participants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <utility>

#include "services/dds/ros2_link.h"
#include "services/dds/src/domain/domain_config.h"
#include "services/dds/src/domain/user_data.h"
#include "services/dds/src/entities.h"
#include "services/security/authority.h"
#include "services/security/member_keys.h"
#include "tests/support/await.h"
#include "tests/support/temp_dir.h"
#include "tests/support/unique_tag.h"

namespace trailcast::dds {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// These are a robot's nodes, with DDS Security or without, on the network of the driver.
class ClosedParticipantsTest : public testing::Test {
 protected:
  ClosedParticipantsTest() {
    options_.robot = "/robot1";
    options_.network_interface = "lo";
    options_.discovery_tag = test::UniqueTag();
  }

  struct Secured {
    Domain domain;
    Participant participant;
  };
  Secured Join(const UserData& said) {
    const auto now = std::chrono::system_clock::now();
    const auto authority =
        security::Authority::Create(folder_ / fmt::format("fleet{}", ++fleets_), now, 2).value();
    const auto keys = authority.Add("robot1", security::Role::kScout, now, 1).value();
    DdsOptions network;
    network.network_interface = options_.network_interface;
    network.discovery_tag = options_.discovery_tag;
    network.keys = security::LoadMemberKeys(keys, now).value();
    auto domain = Domain::Create(DomainConfig(network, {}, "").value()).value();
    auto participant = Participant::Create(domain, ToText(said), /*hidden=*/true).value();
    return {std::move(domain), std::move(participant)};
  }

  test::TempDir folder_;
  int fleets_ = 0;
  Ros2Options options_;
};

TEST_F(ClosedParticipantsTest, ANodeWithDdsSecurityIsToldOfWhileItIsThere) {
  const auto driver = Ros2Driver::Open(options_).value();
  EXPECT_THAT(driver->peers().closed, IsEmpty());
  {
    const Secured node = Join({"camera_driver", std::nullopt});
    EXPECT_TRUE(test::Await([&] { return !driver->peers().closed.empty(); }, "the node"));
    EXPECT_THAT(driver->peers().closed, ElementsAre(HasSubstr("'camera_driver', at 127.0.0.1")));
  }
  EXPECT_TRUE(test::Await([&] { return driver->peers().closed.empty(); }, "that it is gone"));
}

TEST_F(ClosedParticipantsTest, AFleetsMemberAndANodeThatShowsItsTopicsAreNot) {
  const auto driver = Ros2Driver::Open(options_).value();
  const Secured member = Join({"", 8});
  const Secured node = Join({"camera_driver", std::nullopt});
  const auto robot = Ros2Robot::Open(options_).value();
  EXPECT_TRUE(test::Await([&] { return driver->peers().cameras == 1; }, "the robot"));
  EXPECT_TRUE(test::Await([&] { return driver->peers().closed.size() == 1; }, "the closed node"));
  EXPECT_THAT(driver->peers().closed, ElementsAre(HasSubstr("camera_driver")));
}

}  // namespace
}  // namespace trailcast::dds
