#include "route_server/network/zone_admission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"
#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::server {
namespace {

using mission::State;
using std::chrono::seconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// hall of 40 m, narrow from 10 to 14 m, and back, the same way the other way round.
class ZoneAdmissionTest : public testing::Test {
 protected:
  void SetUp() override {
    Put(1, "hall", 40.0);
    Put(2, "back", 40.0);
    Put(3, "yard", 40.0);
    Restart();
    EXPECT_THAT(Edit("narrow hall 10..14 back 26..30"), IsEmpty());
  }
  void Put(unsigned number, const std::string& name, double length_m) {
    route::RouteInfo info =
        test::InfoOf(test::KeyNumber(number, 1), test::PiecesOf(test::KeyNumber(number, 1), 2),
                     route::RouteState::kComplete);
    info.name = name;
    info.length_m = length_m;
    info.standing = route::Standing::kActive;
    ASSERT_TRUE(routes_.PutRoute(info));
  }
  void Restart() {
    keeper_.reset();
    network_.reset();
    missions_.reset();
    auto junctions = store::NetworkStore::Open(folder_ / "joints");
    auto missions = store::MissionStore::Open(folder_ / "missions");
    ASSERT_TRUE(junctions && missions);
    network_ = NetworkRegistry::Open(AgentId("server"), std::move(*junctions), routes_).value();
    missions_ = MissionRegistry::Open(AgentId("server"), std::move(*missions)).value();
    keeper_.emplace(*missions_, *network_);
    (void)keeper_->LookAtAll(now_);
  }
  std::vector<std::string> Edit(const std::string& words) {
    const auto reply = network_->Change({AgentId("desk"), ++requests_, words}, 1000);
    EXPECT_EQ(reply.error, "") << words;
    return keeper_->LookAtAll(now_);
  }
  std::vector<std::string> All() {
    return network_->Answer({.client = AgentId("desk"), .request = ++requests_}).lines;
  }
  void Send(const std::string& robot, const std::string& orders) {
    missions_->Handle(
        mission::Mission{
            .agent = AgentId(robot), .id = "m1", .client = AgentId("desk"), .orders = orders},
        now_, 1000);
    Say(robot, State::kAccepted);
  }
  // In words that say nothing.
  void Say(const std::string& robot, State state, std::uint32_t way = 1, std::uint32_t task = 0) {
    missions_->Handle(mission::Report{.agent = AgentId(robot),
                                      .mission = "m1",
                                      .change = ++change_,
                                      .state = state,
                                      .task = task,
                                      .way = way,
                                      .detail = "xyzzy"},
                      now_, 1000);
  }
  // Returns what is said when it is heard, a second later.
  std::vector<std::string> IsAt(const std::string& robot, unsigned route, double along_m) {
    now_ += seconds(1);
    exchange::AgentStatus status;
    status.agent = AgentId(robot);
    status.role = exchange::AgentRole::kFollower;
    status.place = {test::KeyNumber(route, 1), along_m};
    network_->Hear(status);
    return keeper_->Look(AgentId(robot), now_);
  }
  std::string Orders(const std::string& robot) {
    return missions_->CurrentOf(AgentId(robot))->mission.orders;
  }
  // robot1 comes along hall, and has been let in; robot2 comes back, and waits.
  void Meet() {
    Send("robot1", "goto hall@30 follow hall 0..9.5 wait lane follow hall 9.5..30");
    Send("robot2", "goto back@38 follow back 5..25.5 wait lane follow back 25.5..38");
    Say("robot1", State::kUnderWay);
    Say("robot2", State::kUnderWay);
    EXPECT_THAT(IsAt("robot1", 1, 8.0), IsEmpty());
    EXPECT_THAT(IsAt("robot1", 1, 9.3), ElementsAre("robot1: mission m1 enters hall 10..14"));
    EXPECT_EQ(Orders("robot1"),
              "goto hall@30 way 2 admitted follow hall 9.3..30 because enters hall 10..14");
    Say("robot1", State::kUnderWay, 2);
    EXPECT_THAT(IsAt("robot2", 2, 25.3), IsEmpty()) << "it drives yet";
    Say("robot2", State::kFetching, 1, 1);
    EXPECT_THAT(IsAt("robot2", 2, 25.5),
                ElementsAre("robot2: mission m1 waits for robot1 to leave hall 10..14"));
    EXPECT_EQ(Orders("robot2"),
              "goto back@38 way 2 queued wait lane follow back 25.5..38 because waits "
              "for robot1 to leave hall 10..14");
    Say("robot2", State::kFetching, 2);
  }

  test::TempDir folder_;
  test::MemoryStore routes_;
  std::unique_ptr<NetworkRegistry> network_;
  std::unique_ptr<MissionRegistry> missions_;
  std::optional<ZoneAdmission> keeper_;
  std::chrono::steady_clock::time_point now_{seconds(100)};
  std::uint64_t requests_ = 100;
  std::uint32_t change_ = 0;
};

TEST_F(ZoneAdmissionTest, OneIsLetInAndTheOtherOnceThatIsSeenOutOfIt) {
  Meet();
  EXPECT_THAT(All(), Contains("narrow hall 10..14 back 26..30, taken by robot1"));
  EXPECT_THAT(IsAt("robot1", 1, 14.3), IsEmpty());
  EXPECT_THAT(IsAt("robot2", 2, 25.5), IsEmpty()) << "it is told once";
  EXPECT_THAT(IsAt("robot1", 1, 15.0), IsEmpty()) << "it may be an old word";
  EXPECT_THAT(IsAt("robot1", 1, 16.0),
              ElementsAre("robot1 has left hall 10..14", "robot2: mission m1 enters hall 10..14"));
  EXPECT_THAT(Orders("robot2"), HasSubstr("way 3 admitted follow back 25.5..38 because enters"));
}

TEST_F(ZoneAdmissionTest, ThereHasToBeRoomBeyondIt) {
  Send("robot3", "goto hall@15 follow hall 15..39");
  Say("robot3", State::kUnderWay);
  EXPECT_THAT(IsAt("robot3", 1, 15.5), IsEmpty());
  Send("robot1", "goto hall@30 follow hall 0..9.5 wait lane follow hall 9.5..30");
  Say("robot1", State::kUnderWay);
  EXPECT_THAT(IsAt("robot1", 1, 9.5), IsEmpty());
  Say("robot1", State::kFetching, 1, 1);
  EXPECT_THAT(IsAt("robot1", 1, 9.5),
              ElementsAre(HasSubstr("waits for robot3, which is ahead of it, to go on")));
  EXPECT_THAT(IsAt("robot3", 1, 17.0), IsEmpty());
  Say("robot1", State::kFetching, 2);
  EXPECT_THAT(IsAt("robot1", 1, 9.5), ElementsAre(HasSubstr("enters hall 10..14")));
}

TEST_F(ZoneAdmissionTest, WhoseItIsStandsAlsoAfterARestart) {
  Meet();
  Restart();
  EXPECT_THAT(IsAt("robot2", 2, 25.5), IsEmpty());
  now_ += ZoneAdmission::kSilent;
  EXPECT_THAT(IsAt("robot2", 2, 25.5),
              ElementsAre(AllOf(HasSubstr("waits for robot1 to leave hall 10..14; it is not heard"),
                                HasSubstr("'trailcast network vacate hall 10..14'"))));
  Say("robot1", State::kUnderWay, 2);
  for (const double along_m : {12.0, 15.0}) EXPECT_THAT(IsAt("robot1", 1, along_m), IsEmpty());
  EXPECT_THAT(IsAt("robot1", 1, 16.0), Contains("robot1 has left hall 10..14"));
}

// A reason that has no room in one line of orders is told short.
TEST_F(ZoneAdmissionTest, AReasonThatIsToldShortIsToldOnce) {
  Meet();
  std::string way = "goto back@38 follow back 5..25.5 wait lane follow back 25.5..38";
  for (int i = 0; i < 22; ++i) way += " follow back 34..35";
  Send("robot3", way);
  Say("robot3", State::kFetching, 1, 1);
  EXPECT_THAT(IsAt("robot3", 2, 25.4), ElementsAre(HasSubstr("robot3: mission m1 waits for")));
  const std::string told = Orders("robot3");
  EXPECT_EQ(told.size(), exchange::kMaxLineBytes);
  Say("robot3", State::kFetching, 2);
  EXPECT_THAT(IsAt("robot3", 2, 25.4), IsEmpty());
  EXPECT_EQ(Orders("robot3"), told);
}

TEST_F(ZoneAdmissionTest, OneThatFailsInItKeepsItUntilAnOperatorSaysOtherwise) {
  Meet();
  (void)IsAt("robot1", 1, 12.0);
  Say("robot1", State::kFailed);
  for (int i = 0; i < 5; ++i) EXPECT_THAT(IsAt("robot1", 1, 12.0), IsEmpty());
  EXPECT_THAT(IsAt("robot2", 2, 25.5), IsEmpty());
  EXPECT_THAT(All(), Contains(HasSubstr("taken by robot1")));
  EXPECT_THAT(Edit("vacate hall 10..14"), IsEmpty());
  EXPECT_THAT(IsAt("robot2", 2, 25.5), ElementsAre(HasSubstr("enters hall 10..14")));
}

TEST_F(ZoneAdmissionTest, OneThatIsNotHeardIsBarredWhenAnOperatorHasLooked) {
  Meet();
  EXPECT_THAT(Edit("vacate back"),
              ElementsAre(HasSubstr("robot1: mission m1 is told to wait: hall 10..14 is narrow")));
  EXPECT_THAT(Orders("robot1"),
              HasSubstr("way 3 follow hall 9.3..9.5 wait lane follow hall 9.5..30"));
  EXPECT_THAT(IsAt("robot2", 2, 25.5), ElementsAre(HasSubstr("enters hall 10..14")));
}

TEST_F(ZoneAdmissionTest, OneWhoseMissionIsCancelledBeforeItNeedsItNoMore) {
  Meet();
  Say("robot1", State::kCancelled);
  EXPECT_THAT(IsAt("robot1", 1, 9.3), IsEmpty());
  EXPECT_THAT(IsAt("robot1", 1, 9.3), Contains("robot1 has left hall 10..14"));
}

TEST_F(ZoneAdmissionTest, ARobotThatIsSentByHandHasWhatItIsSentOver) {
  Send("robot3", "follow hall");
  EXPECT_THAT(IsAt("robot3", 3, 1.0), IsEmpty()) << "where it was before";
  Say("robot3", State::kUnderWay);
  EXPECT_THAT(IsAt("robot3", 1, 2.0), IsEmpty());
  Send("robot2", "goto back@38 follow back 25..25.5 wait lane follow back 25.5..38");
  Say("robot2", State::kFetching, 1, 1);
  (void)IsAt("robot2", 2, 25.5);
  EXPECT_THAT(Orders("robot2"), HasSubstr("way 2 queued wait lane")) << Orders("robot2");
  EXPECT_THAT(Orders("robot2"), HasSubstr("waits for robot3 to leave hall 10..14"));
}

TEST_F(ZoneAdmissionTest, OneThatIsSeenInWhatAnotherHasIsTold) {
  Meet();
  EXPECT_THAT(IsAt("stranger", 2, 28.0),
              ElementsAre("stranger is in hall 10..14, which robot1 has: it is not stopped"));
  EXPECT_THAT(All(), Contains(HasSubstr("taken by robot1 stranger")));
}

TEST_F(ZoneAdmissionTest, WhatBecomesNarrowUnderWayIsItsOwnUntilItHasHeardThatItIsToWait) {
  Send("robot1", "goto yard@30 follow yard 0..30");
  Say("robot1", State::kUnderWay);
  EXPECT_THAT(IsAt("robot1", 3, 2.0), IsEmpty());
  EXPECT_THAT(Edit("narrow yard 10..14"),
              ElementsAre("robot1: mission m1 is told to wait: yard 10..14 is narrow: follow yard "
                          "2..9.5 wait lane follow yard 9.5..30"));
  EXPECT_THAT(All(), Contains("narrow yard 10..14, taken by robot1"));
  for (int i = 0; i < 3; ++i) EXPECT_THAT(IsAt("robot1", 3, 3.0), IsEmpty());
  Say("robot1", State::kUnderWay, 2);
  (void)IsAt("robot1", 3, 4.0);
  EXPECT_THAT(IsAt("robot1", 3, 5.0), ElementsAre("robot1 has left yard 10..14"));
  EXPECT_THAT(All(), Contains("narrow yard 10..14"));
  EXPECT_THAT(Edit("wide hall"), IsEmpty());
  EXPECT_THAT(Edit("wide yard"), IsEmpty());
  EXPECT_THAT(All(), Not(Contains(HasSubstr("narrow"))));
  EXPECT_THAT(IsAt("robot1", 3, 9.4),
              ElementsAre("robot1: mission m1 enters what is no longer narrow"));
}

TEST_F(ZoneAdmissionTest, AWayIsAnsweredWithWhereItWaits) {
  const auto reply = network_->Answer(
      {.client = AgentId("desk"), .request = ++requests_, .words = "way hall@2 hall@30"});
  EXPECT_THAT(reply.lines, ElementsAre("follow hall 2..9.5", "wait lane", "follow hall 9.5..30"))
      << reply.error;
  const auto beyond = network_->Change({AgentId("desk"), ++requests_, "narrow hall 30..50"}, 1000);
  EXPECT_THAT(beyond.error, HasSubstr("40.00 m long"));
}

}  // namespace
}  // namespace trailcast::server
