// A driver meets robots whose nodes are configured as ROS 2's layers over Cyclone DDS configure
// theirs for each of its settings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "services/dds/ros2_link.h"
#include "services/dds/src/ros2/ros2_network.h"
#include "tests/support/await.h"
#include "tests/support/unique_tag.h"

namespace trailcast::dds {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

class Ros2NetworkTest : public testing::Test {
 protected:
  Ros2NetworkTest() {
    options_.robot = "/robot1";
    options_.discovery_tag = test::UniqueTag();
  }
  ~Ros2NetworkTest() override { Configure(nullptr); }
  Ros2NetworkTest(const Ros2NetworkTest&) = delete;
  Ros2NetworkTest& operator=(const Ros2NetworkTest&) = delete;

  static void Configure(const char* uri) {
    if (uri == nullptr) {
      unsetenv("CYCLONEDDS_URI");  // NOLINT(concurrency-mt-unsafe)
    } else {
      setenv("CYCLONEDDS_URI", uri, 1);  // NOLINT(concurrency-mt-unsafe)
    }
  }
  // With the driver there first, or the robot.
  bool Meet(const char* robots_uri, bool driver_first) {
    std::unique_ptr<Ros2Driver> driver;
    if (driver_first) driver = Ros2Driver::Open(options_).value();
    Configure(robots_uri);
    const auto robot = Ros2Robot::Open(options_).value();
    Configure(nullptr);
    if (!driver) driver = Ros2Driver::Open(options_).value();
    const auto deadline = steady_clock::now() + test::kLongEnough;
    while (steady_clock::now() < deadline) {
      if (robot->Publish(Ros2Odometry{}) && !driver->Take(milliseconds(20)).empty()) return true;
    }
    return false;
  }
  void ExpectMet(const char* robots_uri) {
    EXPECT_TRUE(Meet(robots_uri, true)) << "the driver first";
    EXPECT_TRUE(Meet(robots_uri, false)) << "the robot first";
  }

  Ros2Options options_;
};

TEST_F(Ros2NetworkTest, MeetsNodesWithRos2sDefaults) { ExpectMet(nullptr); }

TEST_F(Ros2NetworkTest, MeetsNodesOfThisComputerOnly) {  // ROS_LOCALHOST_ONLY=1
  ExpectMet(
      "<CycloneDDS><Domain><General><Interfaces><NetworkInterface address=\"127.0.0.1\"/>"
      "</Interfaces></General></Domain></CycloneDDS>");
}

TEST_F(Ros2NetworkTest, MeetsNodesThatDiscoverOnThisComputerOnly) {  // ..._RANGE=LOCALHOST
  ExpectMet(
      "<CycloneDDS><Domain><General><AllowMulticast>false</AllowMulticast></General><Discovery>"
      "<ParticipantIndex>auto</ParticipantIndex>"
      "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
      "<Peers><Peer address=\"localhost\"/></Peers></Discovery></Domain></CycloneDDS>");
}

TEST_F(Ros2NetworkTest, MeetsNodesThatForceMulticastOnTheLoopback) {
  ExpectMet(
      "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/>"
      "</Interfaces></General></Domain></CycloneDDS>");
}

TEST_F(Ros2NetworkTest, AnInterfaceMayBeNamedInTheEnvironmentAndByOption) {
  options_.network_interface = "lo";
  Configure(
      "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/>"
      "</Interfaces></General></Domain></CycloneDDS>");
  const auto driver = Ros2Driver::Open(options_);
  EXPECT_TRUE(driver) << driver.error().message;
}

TEST_F(Ros2NetworkTest, TellsWhereItLooks) {
  EXPECT_THAT(MeetRos2("lo", "").tried, HasSubstr("leave out --ros-interface lo"));
  EXPECT_THAT(MeetRos2("wlan0", "").tried, HasSubstr("wlan0 and lo"));
  EXPECT_THAT(MeetRos2("", "<NetworkInterface name=\"wlan0\"/>").tried,
              HasSubstr("CYCLONEDDS_URI"));
}

}  // namespace
}  // namespace trailcast::dds
