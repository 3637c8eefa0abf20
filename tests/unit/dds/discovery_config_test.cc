#include "services/dds/src/domain/discovery_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::dds {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(DiscoveryConfig, AMeshIsCyclonesOwnAndCallsTheMembersOfAStar) {
  const std::string config = DiscoveryConfig({}, {});
  EXPECT_THAT(config, HasSubstr("<Peers><Peer Address=\"239.255.0.2:7402\"/></Peers>"));
  EXPECT_THAT(config, Not(HasSubstr("Multicast")));
}

TEST(DiscoveryConfig, AStarCallsWhereMeshesMeetAndDoesNotListenThere) {
  DdsOptions options;
  options.domain_id = 3;
  const std::string config = DiscoveryConfig(options, {.star = true});
  EXPECT_THAT(config, HasSubstr("<Peer Address=\"239.255.0.1:8150\"/>"));
  EXPECT_THAT(config, HasSubstr("<SPDPMulticastAddress>0.0.0.0<"));
  EXPECT_THAT(config, Not(HasSubstr("AllowMulticast")));  // data as the network has it
}

TEST(DiscoveryConfig, AServerCallsTheStarsAtItsFixedPorts) {
  DdsOptions options;
  options.serves = true;
  EXPECT_THAT(DiscoveryConfig(options, {.fixed_ports = true}), HasSubstr("<ParticipantIndex>0<"));
  const std::string config = DiscoveryConfig(options, {});
  EXPECT_THAT(config, HasSubstr("<Peer Address=\"239.255.0.2:7402\"/>"));
  EXPECT_THAT(config, Not(HasSubstr("ParticipantIndex")));
}

TEST(DiscoveryConfig, AddressesAreWhereServersListen) {
  DdsOptions options;
  options.domain_id = 1;
  const std::string config =
      DiscoveryConfig(options, {.star = true, .servers = {"127.0.0.1", "127.0.0.2"}});
  EXPECT_EQ(ServerAt("127.0.0.1", 1), "127.0.0.1:7660");
  EXPECT_THAT(config,
              HasSubstr("<Peer Address=\"127.0.0.1:7660\"/><Peer Address=\"127.0.0.2:7660\"/>"));
  EXPECT_THAT(config, HasSubstr("<AllowMulticast>false<"));
  EXPECT_THAT(config, Not(HasSubstr("239.255."))) << "where multicast does not get through";
}

}  // namespace
}  // namespace trailcast::dds
