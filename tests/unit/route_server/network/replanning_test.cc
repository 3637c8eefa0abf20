#include "route_server/network/replanning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::server {
namespace {

using mission::State;
using std::chrono::seconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// hall of 20 m leads to office, at 12 m by itself and at 5 m by yard.
class ReplanningTest : public testing::Test {
 protected:
  void SetUp() override {
    Put(1, "hall", 20.0);
    Put(2, "office", 10.0);
    Put(3, "yard", 30.0);
    Restart();
    Edit("join hall@12 office@0");
    Edit("join hall@5 yard@0");
    Edit("join yard@30 office@4");
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
    replanning_.reset();
    network_.reset();
    missions_.reset();
    auto junctions = store::NetworkStore::Open(folder_ / "joints");
    auto missions = store::MissionStore::Open(folder_ / "missions");
    ASSERT_TRUE(junctions && missions);
    network_ = NetworkRegistry::Open(AgentId("server"), std::move(*junctions), routes_).value();
    missions_ = MissionRegistry::Open(AgentId("server"), std::move(*missions)).value();
    replanning_.emplace(*missions_, *network_);
  }
  // Returns what an operator who changes it is told of robots.
  std::vector<std::string> Edit(const std::string& words) {
    const auto reply = network_->Change({AgentId("desk"), ++requests_, words}, 1000);
    EXPECT_EQ(reply.error, "") << words;
    return replanning_->LookAtAll(now_);
  }
  void Send(const std::string& orders) {
    missions_->Handle(mission::Mission{.agent = robot_,
                                       .id = "m1",
                                       .client = AgentId("desk"),
                                       .orders = orders,
                                       .valid_for_s = 60},
                      now_, 1000);
    Say(State::kAccepted, 0);
  }
  // In words that say nothing.
  void Say(State state, std::uint32_t task, std::uint32_t way = 1,
           mission::WaitsFor waits_for = mission::WaitsFor::kNothing,
           const std::string& detail = "xyzzy") {
    missions_->Handle(mission::Report{.agent = robot_,
                                      .mission = "m1",
                                      .change = ++change_,
                                      .state = state,
                                      .task = task,
                                      .way = way,
                                      .waits_for = waits_for,
                                      .detail = detail},
                      now_, 1000);
  }
  void AskForWay(std::uint32_t way = 1) { Say(State::kFetching, 0, way, mission::WaitsFor::kWay); }
  // Returns what is said of it when it is heard.
  std::string IsAt(unsigned route, double along_m, double speed_mps = 0.0) {
    return Hear(exchange::PlaceOnRoute{test::KeyNumber(route, 1), along_m}, speed_mps);
  }
  std::string Hear(const std::optional<exchange::PlaceOnRoute>& place, double speed_mps = 0.0) {
    exchange::AgentStatus status;
    status.agent = robot_;
    status.role = exchange::AgentRole::kFollower;
    status.place = place;
    status.speed_mps = speed_mps;
    network_->Hear(status);
    return replanning_->Look(robot_, now_);
  }
  void Drives(const std::string& orders, unsigned route, double along_m, double speed_mps = 0.0) {
    Send(orders);
    Say(State::kUnderWay, 0);
    EXPECT_EQ(IsAt(route, along_m, speed_mps), "");
  }
  std::string Orders() { return missions_->CurrentOf(robot_)->mission.orders; }

  const AgentId robot_{"robot1"};
  const std::string direct_ = "goto office@8 follow hall 0..12 follow office 0..8";
  test::TempDir folder_;
  test::MemoryStore routes_;
  std::unique_ptr<NetworkRegistry> network_;
  std::unique_ptr<MissionRegistry> missions_;
  std::optional<Replanning> replanning_;
  std::chrono::steady_clock::time_point now_{seconds(100)};
  std::uint64_t requests_ = 100;
  std::uint32_t change_ = 0;
};

TEST_F(ReplanningTest, ARobotUnderWayGoesRoundWhatIsClosed) {
  Drives(direct_, 1, 2.0);
  EXPECT_THAT(Edit("close hall 7..9"),
              ElementsAre("robot1: mission m1 is re-planned: hall 7..9 was closed: follow hall "
                          "2..5 follow yard 0..30 follow office 4..8"));
  EXPECT_EQ(Orders(),
            "goto office@8 way 2 follow hall 2..5 follow yard 0..30 follow office 4..8 because "
            "hall 7..9 was closed");
  EXPECT_THAT(Edit("limit office cost 2"), IsEmpty());
  EXPECT_THAT(Edit("open hall"), IsEmpty()) << "it goes on the way that it goes";
}

TEST_F(ReplanningTest, WhatIsClosedElsewhereOrBehindItIsNothingToIt) {
  Drives(direct_, 1, 6.0);
  EXPECT_THAT(Edit("close hall 2..6"), IsEmpty());
  EXPECT_THAT(Edit("close yard"), IsEmpty());
  EXPECT_THAT(Edit("close hall 12.."), IsEmpty());
  EXPECT_THAT(Edit("close office 8.."), IsEmpty()) << "it arrives where that begins";
  EXPECT_EQ(Orders(), direct_);
}

TEST_F(ReplanningTest, ItIsPlannedFromWhereItCanHaveHeardOfItOrFromWhereItIs) {
  Drives(direct_, 1, 3.0, 1.0);
  Edit("close hall 7..9");
  EXPECT_THAT(Orders(), HasSubstr("follow hall 3..5 follow yard"));
  Edit("open hall");
  EXPECT_EQ(IsAt(1, 4.5, 1.0), "");
  Edit("close yard 3..4");
  EXPECT_THAT(Orders(), HasSubstr("way 3 follow hall 4.5..12 follow office"));
  EXPECT_EQ(IsAt(1, 4.8, 1.0), "");
  Edit("open yard");
  Edit("close hall 7..9");
  EXPECT_THAT(Orders(), HasSubstr("way 4 follow hall 4.8..5 follow yard"))
      << "it may hear of it in time";
}

TEST_F(ReplanningTest, WithoutAWayItStandsUntilThereIsOneAlsoAfterARestart) {
  Drives(direct_, 1, 2.0, 0.5);
  EXPECT_THAT(Edit("close office 6..7"),
              ElementsAre(AllOf(HasSubstr("m1 waits for a way: office 6..7 was closed; every way "
                                          "from hall@2 to office@8 is closed"),
                                HasSubstr(": wait way"))));
  EXPECT_THAT(Orders(), HasSubstr("goto office@8 way 2 wait way because office 6..7 was closed"));
  Say(State::kFetching, 0);
  EXPECT_EQ(IsAt(1, 2.1), "");
  Restart();
  EXPECT_THAT(Edit("close hall 7..9"), ElementsAre(HasSubstr("has not said where it stands")));
  now_ += seconds(2);
  EXPECT_EQ(IsAt(1, 2.1), "");
  EXPECT_THAT(Edit("open office"), ElementsAre(HasSubstr("is re-planned: there is a way")));
  EXPECT_THAT(Orders(), HasSubstr("way 3 follow hall 2.1..5 follow yard 0..30"));
}

TEST_F(ReplanningTest, WhoIsOnAClosedPartDrivesOnOutOfIt) {
  Drives(direct_, 1, 8.0);
  EXPECT_THAT(Edit("close hall 7..9"),
              ElementsAre("robot1: mission m1 is on hall 7..9 and drives on out of it"));
  EXPECT_EQ(Orders(), direct_);
  Edit("close office 6..7");
  EXPECT_THAT(Orders(), HasSubstr("way 2 follow hall 8..9 wait way because")) << "and waits there";
}

TEST_F(ReplanningTest, WhatWasClosedBeforeItBeganIsFoundWhenItDrives) {
  EXPECT_EQ(IsAt(2, 8.0), "") << "where it was before";
  Send(direct_);
  EXPECT_EQ(IsAt(2, 8.0), "");
  EXPECT_THAT(Edit("close office 6..7"), IsEmpty()) << "it has not begun, and there is no way";
  EXPECT_EQ(Orders(), direct_);
  now_ += seconds(2);
  Say(State::kUnderWay, 0);
  EXPECT_THAT(IsAt(1, 0.1), HasSubstr("waits for a way"));
}

TEST_F(ReplanningTest, OneThatHasMissedWhereItWasToLeaveIsPlannedAnew) {
  Drives(direct_, 1, 4.7, 1.0);
  Edit("close hall 7..9");
  ASSERT_THAT(Orders(), HasSubstr("way 2 follow hall 4.7..5 follow yard"));
  now_ += seconds(4);
  EXPECT_THAT(IsAt(1, 5.9), HasSubstr("had passed where it was to leave"));
  EXPECT_THAT(Orders(), HasSubstr("way 3 wait way"));
  Edit("open hall");
  EXPECT_THAT(Orders(), HasSubstr("way 4 follow hall 5.9..12 follow office 0..8"));
}

TEST_F(ReplanningTest, OneThatHasFoundItselfElsewhereIsLedOnFromThere) {
  Drives(direct_, 1, 3.0, 0.5);
  Say(State::kFetching, 0);  // looks whether it is on yard
  EXPECT_EQ(Hear({}), "");
  now_ += seconds(5);
  AskForWay();
  EXPECT_EQ(Hear({}), "") << "not from where it was before";
  now_ += seconds(2);
  EXPECT_EQ(IsAt(3, 4.0),
            "robot1: mission m1 is re-planned: it has found itself elsewhere: follow yard 4..30 "
            "follow office 4..8");
  EXPECT_THAT(Orders(), HasSubstr("goto office@8 way 2 follow yard 4..30"));
  now_ += seconds(2);
  EXPECT_EQ(IsAt(3, 4.0), "") << "it may not have heard of that yet";
  AskForWay(2);
  now_ += seconds(4);
  EXPECT_THAT(IsAt(1, 2.0), HasSubstr("found itself elsewhere: follow hall 2..12"));
}

TEST_F(ReplanningTest, OneThatHasFoundItselfWhereNoWayLeadsOnWaits) {
  Drives(direct_, 1, 3.0, 0.5);
  AskForWay();
  now_ += seconds(2);
  EXPECT_THAT(IsAt(2, 9.0), AllOf(HasSubstr("waits for a way: it has found itself elsewhere"),
                                  HasSubstr("no way leads from office@9 to office@8")));
  EXPECT_THAT(Orders(), HasSubstr("way 2 wait way because"));
  Edit("join office@9.5 yard@2");
  EXPECT_THAT(Orders(), HasSubstr("way 3 follow office 9..9.5 follow yard 2..30"));
}

TEST_F(ReplanningTest, WordsForPeopleAskForNothing) {
  Drives(direct_, 1, 3.0, 0.5);
  Say(State::kFetching, 0, 1, mission::WaitsFor::kNothing,
      "waits for a way: it finds itself on yard at 4.0 m");
  now_ += seconds(5);
  EXPECT_EQ(IsAt(3, 4.0), "");
  EXPECT_EQ(Orders(), direct_);
  AskForWay();
  now_ += seconds(2);
  EXPECT_THAT(IsAt(3, 4.0), HasSubstr("found itself elsewhere"));
}

// Beyond the junction, where both routes still run side by side.
TEST_F(ReplanningTest, OneThatHasFoundItselfOnOneOfTwoRoutesGoesOnByTheOther) {
  ASSERT_TRUE(network_->Propose({.a = test::KeyNumber(1, 1),
                                 .b = test::KeyNumber(2, 1),
                                 .at_a_m = 15.0,
                                 .at_b_m = 3.0,
                                 .length_m = 6.0,
                                 .confidence = 0.95},
                                0.9, 1000));
  Drives(direct_, 1, 3.0, 0.5);
  AskForWay();
  now_ += seconds(2);
  EXPECT_THAT(IsAt(1, 17.0), HasSubstr(": follow office 5..8"));
  AskForWay(2);
  now_ += seconds(4);
  EXPECT_THAT(IsAt(1, 19.5), HasSubstr("no way leads from hall@19.5")) << "they have parted";
}

TEST_F(ReplanningTest, WhereItMayItBacksOutOfADeadEnd) {
  Edit("back office");
  Edit("join office@1 yard@2");
  Drives("goto yard@10 follow office 3..10", 2, 6.0);
  EXPECT_THAT(Edit("close office 7..8"),
              ElementsAre("robot1: mission m1 is re-planned: office 7..8 was closed: follow office "
                          "backwards 6..1 follow yard 2..10"));
  Say(State::kUnderWay, 0, 2);
  EXPECT_EQ(IsAt(2, 4.0), "");
  EXPECT_THAT(Edit("close office 2..3"),
              ElementsAre("robot1: mission m1 waits for a way: office 2..3 was closed; every way "
                          "from office@4 to yard@10 is closed; on the least closed: office 2..3: "
                          "wait way"));
}

TEST_F(ReplanningTest, OneThatIsToTurnRoundBeforeARouteStillIs) {
  Edit("join hall@20 yard@1 heading 180");
  Drives("goto yard@9 follow hall 2..20 turn 180 follow yard 1..9", 1, 4.0);
  EXPECT_THAT(
      Edit("close yard 4..5"),
      ElementsAre("robot1: mission m1 waits for a way: yard 4..5 was closed; every way from "
                  "hall@4 to yard@9 is closed; on the least closed: yard 4..5: wait way"));
  EXPECT_THAT(Edit("open yard"),
              ElementsAre("robot1: mission m1 is re-planned: there is a way: follow hall 4..5 "
                          "follow yard 0..9"));
  Edit("part hall@5 yard@0");
  EXPECT_EQ(Orders(), "goto yard@9 way 3 follow hall 4..5 follow yard 0..9 because there is a way");
}

TEST_F(ReplanningTest, OneThatWasSentByHandIsTold) {
  Drives("follow hall", 1, 2.0);
  EXPECT_THAT(Edit("close hall 7..9"),
              ElementsAre(HasSubstr("leads over hall 7..9 and was sent by hand")));
  EXPECT_EQ(Orders(), "follow hall");
  EXPECT_EQ(IsAt(1, 3.0), "") << "once";
}

TEST_F(ReplanningTest, AGoalThatIsForgottenIsSaid) {
  Edit("name bay office@8");
  Drives("goto bay follow hall 0..12 follow office 0..8", 1, 2.0);
  Edit("forget bay");
  EXPECT_THAT(Edit("close hall 7..9"), ElementsAre(HasSubstr("no place is called 'bay'")));
  EXPECT_THAT(Orders(), HasSubstr("wait way because hall 7..9 was closed"));
}

}  // namespace
}  // namespace trailcast::server
