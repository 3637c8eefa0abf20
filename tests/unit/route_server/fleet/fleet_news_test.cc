#include "route_server/fleet/fleet_news.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"

namespace trailcast::server {
namespace {

using exchange::AgentGone;
using exchange::AgentMode;
using exchange::AgentStatus;
using exchange::ClaimedName;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FleetNewsTest : public testing::Test {
 protected:
  void Hear(const std::string& agent, std::uint64_t instance,
            AgentMode mode = AgentMode::kReplaying) {
    news_.Handle(AgentStatus{.agent = AgentId(agent), .instance = instance, .mode = mode});
  }
  // Returns what is told of names now that they have changed.
  std::vector<ClaimedName> Told() {
    now_ += FleetNews::kClaimsEvery;
    const auto fleet = news_.Due(now_);
    return fleet ? fleet->claimed : std::vector<ClaimedName>{{AgentId("nothing"), 0, 0}};
  }

  FleetNews::Time now_ = FleetNews::Time() + seconds(1000);
  FleetNews news_{AgentId("server")};
};

TEST_F(FleetNewsTest, TellsHowManyAgentsThereAreWhenThatHasChangedByMuchOrForLong) {
  ASSERT_TRUE(news_.Due(now_));  // who joins late gets the latest
  for (int i = 0; i < 20; ++i) Hear("agent-" + std::to_string(i), 1);
  EXPECT_FALSE(news_.Due(now_ + milliseconds(500)));
  now_ += FleetNews::kNumberEvery;
  EXPECT_EQ(news_.Due(now_)->agents, 20U);
  Hear("one-more", 1);
  EXPECT_FALSE(news_.Due(now_ + FleetNews::kNumberEvery));
  now_ += FleetNews::kLittleEvery;
  EXPECT_EQ(news_.Due(now_)->agents, 21U);
  EXPECT_FALSE(news_.Due(now_ + seconds(1000))) << "nothing has changed";
  news_.Handle(AgentGone{AgentId("one-more"), 1});
  Hear("agent-0", 1, AgentMode::kStopped);
  now_ += FleetNews::kLittleEvery;
  EXPECT_EQ(news_.Due(now_)->agents, 19U);
}

TEST_F(FleetNewsTest, WhoWasThereBeforeKeepsItsNameOnceItSpeaks) {
  Hear("robot", 9);
  ASSERT_THAT(Told(), IsEmpty());
  Hear("robot", 5, AgentMode::kStarting);
  EXPECT_THAT(Told(), ElementsAre(ClaimedName{AgentId("robot"), 5, 0}));
  EXPECT_THAT(news_.TakeNotes(), IsEmpty());
  Hear("robot", 9);
  EXPECT_THAT(Told(), ElementsAre(ClaimedName{AgentId("robot"), 5, 9}));
  EXPECT_THAT(news_.TakeNotes(), ElementsAre(HasSubstr("two processes are called 'robot'")));
  EXPECT_EQ(news_.NameTrouble(), "") << "it is being refused";
  news_.Handle(AgentGone{AgentId("robot"), 5});
  EXPECT_THAT(Told(), IsEmpty());
}

TEST_F(FleetNewsTest, OfTwoThatStartTogetherTheSmallerInstanceKeepsTheName) {
  Hear("robot", 9, AgentMode::kStarting);
  Hear("robot", 5, AgentMode::kStarting);
  Hear("robot", 9, AgentMode::kStarting);
  EXPECT_THAT(Told(), ElementsAre(ClaimedName{AgentId("robot"), 5, 5}));
}

TEST_F(FleetNewsTest, AProcessThatWasKilledKeepsNobodyFromItsName) {
  Hear("robot", 9);
  Hear("robot", 5, AgentMode::kStarting);  // started again before the first is known to be gone
  Hear("robot", 5);
  EXPECT_THAT(Told(), ElementsAre(ClaimedName{AgentId("robot"), 5, 0}));
  news_.Handle(AgentGone{AgentId("robot"), 9});
  EXPECT_THAT(Told(), IsEmpty());
  Hear("robot", 7, AgentMode::kStarting);
  Hear("robot", 5);
  EXPECT_THAT(Told(), ElementsAre(ClaimedName{AgentId("robot"), 7, 5}));
}

TEST_F(FleetNewsTest, TwoThatRunAlreadyAreToldOfAsLongAsTheyDo) {
  Hear("robot", 9);
  Hear("robot", 5);
  Hear("robot", 9);
  Hear("robot", 5);
  EXPECT_THAT(Told(), ElementsAre(ClaimedName{AgentId("robot"), 5, 9}));
  EXPECT_THAT(news_.TakeNotes(), testing::SizeIs(1));
  EXPECT_THAT(news_.NameTrouble(), HasSubstr("'robot'"));
  Hear("robot", 9, AgentMode::kStopped);
  EXPECT_THAT(Told(), IsEmpty());
  EXPECT_EQ(news_.NameTrouble(), "");
}

TEST_F(FleetNewsTest, TellsOfNoMoreNamesThanAMessageCarries) {
  for (std::size_t i = 0; i <= exchange::kMaxClaimedNames; ++i) {
    Hear("robot-" + std::to_string(i), 9);
    Hear("robot-" + std::to_string(i), 5);
  }
  EXPECT_EQ(Told().size(), exchange::kMaxClaimedNames);
}

}  // namespace
}  // namespace trailcast::server
