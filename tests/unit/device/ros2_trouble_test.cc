#include "agent/device/src/ros2/ros2_trouble.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Ros2Trouble, WhoseQualityOfServiceDoesNotMatchIsToldWhatToSet) {
  dds::Ros2Options topics;
  topics.robot = "/robot1";
  dds::Ros2Driver::Peers peers;
  const auto names_it =
      AllOf(HasSubstr("does not match: /robot1/cmd_vel (durability)"), HasSubstr("volatile"));
  EXPECT_THAT(NobodyListens(topics, peers), Not(HasSubstr("quality of service")));
  EXPECT_THAT(WhoIsMissing(topics, peers, {}), Not(HasSubstr("quality of service")));
  peers.mismatch = "/robot1/cmd_vel (durability)";
  EXPECT_THAT(NobodyListens(topics, peers), names_it);
  EXPECT_THAT(WhoIsMissing(topics, peers, {}), names_it);
}

TEST(Ros2Trouble, MemoryThatLostPiecesFillIsNamedWithTheWayOut) {
  EXPECT_EQ(NoRoomText(std::nullopt), "");
  EXPECT_EQ(NoRoomText(PacketPieces{3'000'000, 4'194'304, 30}), "");
  EXPECT_THAT(
      NoRoomText(PacketPieces{4'190'000, 4'194'304, 30}),
      AllOf(HasSubstr("fill the 4 MB"), HasSubstr("up to 30 s"),
            HasSubstr("sysctl -w net.ipv4.ipfrag_time=3 net.ipv4.ipfrag_high_thresh=67108864")));
}

TEST(Ros2Trouble, ARobotWithDdsSecurityIsToldHowToBeMet) {
  dds::Ros2Options topics;
  topics.robot = "/robot1";
  dds::Ros2Driver::Peers peers;
  EXPECT_THAT(WhoIsMissing(topics, peers, {}), Not(HasSubstr("Security")));
  peers.closed = {"participant 1:2:3, at 10.0.0.7:7411"};
  EXPECT_THAT(WhoIsMissing(topics, peers, {}),
              AllOf(HasSubstr("participant 1:2:3, at 10.0.0.7:7411 is there"),
                    HasSubstr("ROS_SECURITY_ENABLE=false")));
  peers.cameras = peers.odometers = 1;
  EXPECT_THAT(WhoIsMissing(topics, peers, {}), Not(HasSubstr("Security")))
      << "the robot is another one";
}

}  // namespace
}  // namespace trailcast::agent
