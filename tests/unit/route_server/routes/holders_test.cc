#include "route_server/routes/holders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::server {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Holders::Time kNow{};
const route::RouteKey kOld = test::KeyNumber(1, 1);
const route::RouteKey kNew = test::KeyNumber(1, 2);

exchange::AgentStatus Status(const std::string& agent, std::vector<route::RouteKey> held,
                             exchange::AgentMode mode = exchange::AgentMode::kWaiting) {
  exchange::AgentStatus status;
  status.agent = AgentId(agent);
  status.mode = mode;
  status.held = std::move(held);
  return status;
}

std::vector<route::RouteInfo> Page(const route::RouteKey& key) {
  return {test::InfoOf(key, {}, route::RouteState::kComplete)};
}

TEST(Holders, TheLastWordOfEachAgentCounts) {
  Holders holders;
  holders.Note(Status("robot-1", {kOld}), kNow);
  holders.Note(Status("robot-2", {kNew, kOld}), kNow);
  EXPECT_THAT(holders.Of(Page(kNew), kNow),
              ElementsAre(exchange::Holding{kNew, AgentId("robot-2")}));
  holders.Note(Status("robot-1", {kNew}), kNow);
  EXPECT_THAT(holders.Of(Page(kOld), kNow),
              ElementsAre(exchange::Holding{kOld, AgentId("robot-2")}));
  EXPECT_EQ(holders.Of(Page(kNew), kNow).size(), 2U);
}

TEST(Holders, OneThatIsLongGoneIsToldOfNoLonger) {
  Holders holders;
  holders.Note(Status("robot-1", {kOld}), kNow);
  EXPECT_EQ(holders.Of(Page(kOld), kNow + Holders::kForgotten).size(), 1U);
  const Holders::Time later = kNow + Holders::kForgotten + std::chrono::seconds(1);
  EXPECT_THAT(holders.Of(Page(kOld), later), IsEmpty());
  holders.Note(Status("robot-1", {kOld}), later);
  EXPECT_EQ(holders.Of(Page(kOld), later).size(), 1U) << "back again, with the same";
}

TEST(Holders, OneThatHasJustStartedHasNotLookedYet) {
  Holders holders;
  holders.Note(Status("robot-1", {kOld}), kNow);
  holders.Note(Status("robot-1", {}, exchange::AgentMode::kStarting), kNow);
  EXPECT_EQ(holders.Of(Page(kOld), kNow).size(), 1U);
  holders.Note(Status("robot-1", {}), kNow);
  EXPECT_THAT(holders.Of(Page(kOld), kNow), IsEmpty());
}

TEST(Holders, MadeUpNamesDoNotCrowdOutWhoIsHeard) {
  Holders holders;
  holders.Note(Status("robot-1", {kOld}), kNow);
  for (std::size_t i = 0; i < 2 * Holders::kMostAgents; ++i) {
    holders.Note(Status(fmt::format("made-up-{}", i), {kNew}), kNow);
    if (i % 1000 == 0) holders.Note(Status("robot-1", {kOld}), kNow);
  }
  EXPECT_THAT(holders.Of(Page(kOld), kNow),
              ElementsAre(exchange::Holding{kOld, AgentId("robot-1")}));
  const AgentId first("made-up-0");
  for (const exchange::Holding& holding : holders.Of(Page(kNew), kNow)) {
    EXPECT_NE(holding.agent, first) << "the oldest go";
  }
  holders.Note(Status("robot-2", {kOld}), kNow);
  EXPECT_EQ(holders.Of(Page(kOld), kNow).size(), 2U) << "there is room for who is new";
}

}  // namespace
}  // namespace trailcast::server
