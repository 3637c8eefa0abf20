#include "route_server/fleet/route_followers.h"

#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::server {
namespace {

using exchange::AgentGone;
using exchange::AgentMode;
using exchange::AgentStatus;
using exchange::RouteFollower;
using exchange::RouteFollowers;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::KeyNumber;
using Registry = FollowerRegistry;

class RouteFollowersTest : public testing::Test {
 protected:
  void Hear(const std::string& agent, double along_m, int route = 1,
            AgentMode mode = AgentMode::kReplaying) {
    registry_.Handle(AgentStatus{.agent = AgentId(agent),
                                 .instance = 1,
                                 .role = exchange::AgentRole::kFollower,
                                 .mode = mode,
                                 .speed_mps = 0.4,
                                 .place = exchange::PlaceOnRoute{KeyNumber(route), along_m}},
                     now_);
  }
  // Told within the next second, of route 1: the latest.
  std::vector<RouteFollower> Told() {
    std::vector<RouteFollower> latest;
    for (const auto until = now_ + seconds(1); now_ < until;) {
      now_ += milliseconds(50);
      for (RouteFollowers& told : registry_.Due(now_)) {
        if (told.key == KeyNumber(1)) latest = std::move(told.followers);
      }
    }
    return latest;
  }
  // How often route 1 is told of in so long a time.
  int TimesIn(seconds time) {
    int times = 0;
    for (const auto until = now_ + time; now_ < until;) {
      now_ += milliseconds(50);
      times += static_cast<int>(registry_.Due(now_).size());
    }
    return times;
  }

  Registry::Time now_ = Registry::Time() + seconds(1000);
  Registry registry_{AgentId("server")};
};

TEST_F(RouteFollowersTest, TellsThoseOnARouteOfEachOther) {
  Hear("a", 1.0);
  Hear("c", 9.0, 2);
  EXPECT_TRUE(Told().empty()) << "nobody is beside it";
  Hear("a", 2.0);
  Hear("b", 3.0);
  now_ += milliseconds(50);
  const auto told = registry_.Due(now_);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told.front(),
            (RouteFollowers{.server = AgentId("server"),
                            .key = KeyNumber(1),
                            .followers = {{AgentId("a"), 2.0, 0.4, true, milliseconds(50)},
                                          {AgentId("b"), 3.0, 0.4, true, milliseconds(50)}}}));
}

TEST_F(RouteFollowersTest, TellsFiveTimesASecondAndMoreRarelyOfMany) {
  Hear("a", 1.0);
  Hear("b", 2.0);
  EXPECT_EQ(TimesIn(seconds(10)), 50);
  for (int i = 0; i < 198; ++i) Hear("follower-" + std::to_string(i), i);
  (void)TimesIn(seconds(2));
  EXPECT_EQ(TimesIn(seconds(10)), 5);
}

TEST_F(RouteFollowersTest, WhoArrivedOrIsOnAnotherRouteHasMadeRoom) {
  Hear("a", 1.0);
  Hear("b", 2.0);
  Hear("c", 3.0);
  Hear("b", 5.0, 1, AgentMode::kArrived);
  Hear("c", 1.0, 2);
  const auto told = Told();
  ASSERT_EQ(told.size(), 1U) << "who is left is told so";
  EXPECT_EQ(told.front().agent, AgentId("a"));
  EXPECT_EQ(TimesIn(seconds(20)), 9) << "for a while";
}

TEST_F(RouteFollowersTest, WhoIsNotHeardStandsWhereItWasForAWhile) {
  Hear("a", 1.0);
  Hear("b", 2.0);
  registry_.Handle(AgentGone{AgentId("b"), 2}, now_);  // another process of its name
  EXPECT_TRUE(Told().back().heard);
  registry_.Handle(AgentGone{AgentId("b"), 1}, now_);
  const auto told = Told();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_FALSE(told.back().heard);
  EXPECT_EQ(told.back().along_m, 2.0);
  for (int i = 0; i < 62; ++i) {
    Hear("a", 1.0);
    (void)Told();
  }
  ASSERT_EQ(Told().size(), 1U);
}

TEST_F(RouteFollowersTest, AFollowerThatWasRestartedStaysWhereItWasUntilItKnowsBetter) {
  Hear("a", 1.0);
  Hear("b", 2.0);
  registry_.Handle(AgentStatus{.agent = AgentId("b"),
                               .instance = 2,
                               .role = exchange::AgentRole::kFollower,
                               .mode = AgentMode::kStarting},
                   now_);
  EXPECT_EQ(Told().size(), 2U);
}

}  // namespace
}  // namespace trailcast::server
