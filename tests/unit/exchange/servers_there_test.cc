#include "services/exchange/servers_there.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::exchange {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

AgentStatus Status(const std::string& name, std::uint64_t instance,
                   AgentMode mode = AgentMode::kWaiting, AgentRole role = AgentRole::kServer) {
  AgentStatus status;
  status.agent = AgentId(name);
  status.instance = instance;
  status.mode = mode;
  status.role = role;
  return status;
}

TEST(ServersThere, AreThoseThatWereHeardAndHaveNotGone) {
  ServersThere servers;
  servers.Handle(Status("b", 1));
  servers.Handle(Status("a", 2));
  servers.Handle(Status("c", 3));
  servers.Handle(Status("scout", 4, AgentMode::kTeaching, AgentRole::kScout));
  servers.Handle(AgentGone{AgentId("b"), 1});
  servers.Handle(Status("c", 3, AgentMode::kStopped));
  EXPECT_THAT(servers.Names(), ElementsAre(AgentId("a")));
  EXPECT_TRUE(servers.Contains(AgentId("a")));
  EXPECT_FALSE(servers.Contains(AgentId("b")));
  EXPECT_FALSE(servers.Contains(AgentId("scout")));
}

TEST(ServersThere, ANameIsThereUntilAllItsProcessesHaveGone) {
  ServersThere servers;
  servers.Handle(Status("a", 1));
  servers.Handle(Status("a", 2));
  servers.Handle(AgentGone{AgentId("a"), 1});
  EXPECT_THAT(servers.Names(), ElementsAre(AgentId("a")));
  servers.Handle(AgentGone{AgentId("a"), 2});
  EXPECT_TRUE(servers.empty());
}

TEST(ServersThere, NamesThatAreMadeUpAreRememberedUpToABound) {
  ServersThere servers;
  for (std::size_t i = 0; i < 2 * ServersThere::kMost; ++i) {
    servers.Handle(Status(fmt::format("server-{}", i), 1));
  }
  EXPECT_THAT(servers.Names(), SizeIs(ServersThere::kMost));
}

}  // namespace
}  // namespace trailcast::exchange
