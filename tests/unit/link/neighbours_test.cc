#include "agent/link/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/pieces.h"

namespace trailcast::agent {
namespace {

using exchange::AgentGone;
using exchange::AgentMode;
using exchange::AgentStatus;
using std::chrono::seconds;
using test::KeyNumber;

constexpr Neighbours::Time kBegin{std::chrono::hours(1)};

AgentStatus Follower(const std::string& name, std::optional<double> along_m,
                     std::uint64_t instance = 1) {
  AgentStatus status;
  status.agent = AgentId(name);
  status.instance = instance;
  status.role = exchange::AgentRole::kFollower;
  status.mode = AgentMode::kReplaying;
  status.speed_mps = 0.4;
  if (along_m) status.place = {KeyNumber(1), *along_m};
  return status;
}

class NeighboursTest : public testing::Test {
 protected:
  void Hear(const exchange::Message& message, seconds at = seconds(0)) {
    neighbours_.Handle(message, kBegin + at);
  }
  // Places of those on the route.
  std::vector<double> Places() {
    std::vector<double> places;
    for (const Neighbour& other : neighbours_.On(KeyNumber(1))) places.push_back(other.along_m);
    return places;
  }
  using These = std::vector<double>;
  Neighbours neighbours_{AgentId("self")};
};

TEST_F(NeighboursTest, KnowsWhereOthersLastWere) {
  Hear(Follower("a", 2.0));
  Hear(Follower("a", 3.0), seconds(1));
  Hear(Follower("b", 1.0), seconds(1));
  const auto on = neighbours_.On(KeyNumber(1));
  ASSERT_EQ(on.size(), 2U);
  EXPECT_EQ(on[0], (Neighbour{AgentId("a"), 3.0, 0.4, kBegin + seconds(1), true}));
}

TEST_F(NeighboursTest, AnotherRevisionsPlacesAreNotComparable) {
  AgentStatus status = Follower("a", 2.0);
  status.place->key.teaching = TeachingId(2);
  Hear(status);
  EXPECT_EQ(Places(), These{});
}

TEST_F(NeighboursTest, ScoutsAndThoseWhoHaveNotFoundTheRouteAreNotInTheWay) {
  AgentStatus scout = Follower("s", 2.0);
  scout.role = exchange::AgentRole::kScout;
  Hear(scout);
  Hear(Follower("a", std::nullopt));
  EXPECT_EQ(Places(), These{});
}

TEST_F(NeighboursTest, ARobotIsNotItsOwnNeighbour) {
  Hear(Follower("self", 2.0, 7));  // of a run before this one, killed a moment ago
  EXPECT_EQ(Places(), These{});
}

TEST_F(NeighboursTest, WhoeverArrivedMakesRoom) {
  Hear(Follower("a", 9.9));
  AgentStatus arrived = Follower("a", 10.0);
  arrived.mode = AgentMode::kArrived;
  Hear(arrived);
  Hear(AgentGone{AgentId("a"), 1});
  EXPECT_EQ(Places(), These{});
}

TEST_F(NeighboursTest, WhoeverStoppedOrIsLostStandsInTheWay) {
  for (const AgentMode mode : {AgentMode::kStopped, AgentMode::kFault, AgentMode::kWaiting}) {
    AgentStatus stopped = Follower("a", 4.0);
    stopped.mode = mode;
    Hear(stopped);
    EXPECT_EQ(Places(), These{4.0});
  }
}

TEST_F(NeighboursTest, WhoeverIsGoneIsTakenToStandWhereItWasForAWhile) {
  Hear(Follower("a", 4.0));
  Hear(AgentGone{AgentId("a"), 1}, seconds(3));
  EXPECT_EQ(Places(), These{4.0});
  EXPECT_FALSE(neighbours_.On(KeyNumber(1))[0].heard);
  EXPECT_TRUE(neighbours_.Forget(kBegin + Neighbours::kRemembered).empty());
  const auto forgotten = neighbours_.Forget(kBegin + Neighbours::kRemembered + seconds(1));
  ASSERT_EQ(forgotten.size(), 1U);
  EXPECT_EQ(forgotten[0].agent, AgentId("a"));
  EXPECT_EQ(Places(), These{});
}

TEST_F(NeighboursTest, WhoeverIsStillConnectedIsNotForgotten) {
  Hear(Follower("a", 4.0));
  EXPECT_TRUE(neighbours_.Forget(kBegin + std::chrono::hours(1)).empty());
  EXPECT_EQ(Places(), These{4.0});
}

TEST_F(NeighboursTest, WhoeverIsHeardAgainIsWhereItSaysNow) {
  Hear(Follower("a", 4.0));
  Hear(AgentGone{AgentId("a"), 1});
  Hear(Follower("a", 6.0), seconds(10));
  EXPECT_EQ(Places(), These{6.0});
  EXPECT_TRUE(neighbours_.On(KeyNumber(1))[0].heard);
}

TEST_F(NeighboursTest, ARestartedAgentStaysWhereItWasUntilItHasFoundItself) {
  Hear(Follower("a", 4.0, 1));
  Hear(Follower("a", std::nullopt, 2), seconds(2));
  Hear(AgentGone{AgentId("a"), 1}, seconds(3));
  EXPECT_EQ(Places(), These{4.0});
  Hear(Follower("a", 4.2, 2), seconds(4));
  Hear(AgentGone{AgentId("a"), 1}, seconds(5));
  EXPECT_EQ(Places(), These{4.2});
  EXPECT_TRUE(neighbours_.On(KeyNumber(1))[0].heard) << "only its last life is over";
}

TEST_F(NeighboursTest, MadeUpNamesDoNotCrowdOutWhoIsHeard) {
  for (std::size_t i = 0; i < 2 * Neighbours::kMost; ++i) {
    if (i % 100 == 0) Hear(Follower("robot", 3.0), seconds(i));
    Hear(Follower(fmt::format("made-up-{}", i), 2.0), seconds(i));
  }
  const auto on = neighbours_.On(KeyNumber(1));
  EXPECT_EQ(on.size(), Neighbours::kMost);
  EXPECT_TRUE(std::any_of(on.begin(), on.end(),
                          [](const Neighbour& other) { return other.agent == AgentId("robot"); }));
}

exchange::RouteFollowers Told(std::vector<exchange::RouteFollower> followers) {
  return {.server = AgentId("server"), .key = KeyNumber(1), .followers = std::move(followers)};
}

TEST_F(NeighboursTest, BelievesAServerOfThoseThatItDoesNotHear) {
  Hear(Told({{AgentId("a"), 2.0, 0.4, true, std::chrono::milliseconds(500)},
             {AgentId("b"), 3.0, 0.0, false, std::chrono::seconds(5)},
             {AgentId("self"), 1.0, 0.4, true, std::chrono::milliseconds(0)}}),
       seconds(10));
  const auto on = neighbours_.On(KeyNumber(1));
  ASSERT_EQ(on.size(), 2U);
  const auto told_at = kBegin + std::chrono::milliseconds(9500);
  EXPECT_EQ(on[0], (Neighbour{AgentId("a"), 2.0, 0.4, told_at, true}));
  EXPECT_EQ(on[1], (Neighbour{AgentId("b"), 3.0, 0.0, kBegin + seconds(5), false}));
}

TEST_F(NeighboursTest, WhoAServerDoesNotTellOfAnyMoreHasMadeRoom) {
  Hear(Told({{AgentId("a"), 2.0, 0.4, true, {}}, {AgentId("b"), 3.0, 0.4, true, {}}}));
  Hear(Follower("c", 4.0));  // heard itself
  Hear(Told({{AgentId("b"), 3.0, 0.4, true, {}}}), seconds(1));
  EXPECT_EQ(Places(), (These{3.0, 4.0}));
}

TEST_F(NeighboursTest, TheLaterWordCountsWhoeverHasIt) {
  Hear(Follower("a", 5.0), seconds(10));
  Hear(Told({{AgentId("a"), 4.0, 0.4, true, std::chrono::seconds(2)}}), seconds(11));
  EXPECT_EQ(Places(), These{5.0});
  Hear(Told({{AgentId("a"), 6.0, 0.4, true, {}}}), seconds(12));
  EXPECT_EQ(Places(), These{6.0});
  Hear(Follower("a", 7.0), seconds(13));
  EXPECT_EQ(Places(), These{7.0});
}

TEST_F(NeighboursTest, WithoutTheServerThatToldOthersAreTakenToStandForAWhile) {
  Hear(Told({{AgentId("a"), 2.0, 0.4, true, {}}}));
  Hear(AgentGone{AgentId("server"), 7}, seconds(3));
  ASSERT_EQ(neighbours_.On(KeyNumber(1)).size(), 1U);
  EXPECT_FALSE(neighbours_.On(KeyNumber(1)).front().heard);
  EXPECT_TRUE(neighbours_.Forget(kBegin + Neighbours::kRemembered).empty());
  EXPECT_EQ(neighbours_.Forget(kBegin + Neighbours::kRemembered + seconds(1)).size(), 1U);
}

}  // namespace
}  // namespace trailcast::agent
