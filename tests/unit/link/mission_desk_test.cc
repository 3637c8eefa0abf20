#include "agent/link/mission_desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <utility>

#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using mission::Mission;
using mission::Report;
using mission::State;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class MissionDeskTest : public testing::Test {
 protected:
  void SetUp() override { Restart(); }
  void Restart() {
    desk_.emplace(AgentId("robot1"), folder_ / "missions");
    ASSERT_TRUE(desk_->Load());
  }
  static Mission For(const std::string& id, const std::string& orders = "follow hall") {
    return {.agent = AgentId("robot1"), .id = id, .client = AgentId("desk-p7"), .orders = orders};
  }
  std::vector<Report> Due(bool server_there = false) {
    std::vector<Report> reports;
    for (const exchange::Message& message : desk_->Due(now_, server_there)) {
      reports.push_back(std::get<Report>(message));
    }
    return reports;
  }
  Report Answer(const Mission& mission) {
    desk_->Handle(mission);
    const auto reports = Due();
    EXPECT_THAT(reports, SizeIs(1));
    return reports.empty() ? Report{} : reports.back();
  }
  void ServerSays(Report report) {
    report.relayed = true;
    desk_->Handle(report);
  }

  test::TempDir folder_;
  std::chrono::steady_clock::time_point now_{seconds(100)};
  std::optional<MissionDesk> desk_;
};

TEST_F(MissionDeskTest, TakesAMissionAndTellsWhatBecomesOfIt) {
  const Report accepted = Answer(For("m1"));
  EXPECT_EQ(accepted.state, State::kAccepted);
  EXPECT_EQ(accepted.change, 1U);
  ASSERT_TRUE(desk_->current());
  EXPECT_EQ(desk_->current()->mission.id, "m1");
  desk_->Tell(State::kUnderWay);
  EXPECT_EQ(Due().at(0).change, 2U);
  desk_->NoteDone();
  desk_->Tell(State::kArrived);
  EXPECT_EQ(Due().at(0).state, State::kArrived);
  EXPECT_FALSE(desk_->current());
}

TEST_F(MissionDeskTest, TheSameOneIsDoneOnceAlsoAfterARestart) {
  (void)Answer(For("m1"));
  desk_->NoteDone();
  desk_->Tell(State::kArrived);
  (void)Due();
  EXPECT_EQ(Answer(For("m1")).state, State::kArrived);
  EXPECT_FALSE(desk_->current());
  Restart();
  (void)Due();
  EXPECT_EQ(Answer(For("m1")).state, State::kArrived);
  EXPECT_FALSE(desk_->current());
}

TEST_F(MissionDeskTest, RefusesASecondOneAndWhatItDoesNotUnderstand) {
  EXPECT_EQ(Answer(For("m0", "dance")).state, State::kRefused);
  (void)Answer(For("m1"));
  const Report refused = Answer(For("m2", "follow yard"));
  EXPECT_EQ(refused.state, State::kRefused);
  EXPECT_THAT(refused.detail, HasSubstr("busy with mission m1: follow hall"));
  EXPECT_EQ(desk_->current()->mission.id, "m1");
}

TEST_F(MissionDeskTest, WhereAServerKeepsMissionsItTakesOneWhenThatHandsItOver) {
  exchange::AgentStatus server;
  server.agent = AgentId("server");
  server.instance = 5;
  server.role = exchange::AgentRole::kServer;
  server.mode = exchange::AgentMode::kWaiting;
  desk_->Handle(server);
  EXPECT_EQ(Answer(For("m0", "wait 1")).state, State::kAccepted) << "that one keeps none";
  desk_->Tell(State::kArrived);
  (void)Due();
  server.on_duty = true;
  desk_->Handle(server);
  Mission first = For("m1");
  Mission second = For("m2", "follow yard");
  for (Mission* mission : {&first, &second}) {
    desk_->Handle(*mission);
    EXPECT_THAT(Due(), IsEmpty());
    mission->relayed = true;
  }
  EXPECT_EQ(Answer(first).state, State::kAccepted);
  desk_->Handle(second);
  EXPECT_THAT(Due(), IsEmpty()) << "it is handed over again";
  desk_->Tell(State::kArrived);
  (void)Due();
  EXPECT_EQ(Answer(second).state, State::kAccepted);
  desk_->Tell(State::kArrived);
  (void)Due();
  desk_->Handle(exchange::AgentGone{server.agent, server.instance});
  EXPECT_EQ(Answer(For("m3")).state, State::kAccepted) << "there is no such server any more";
}

TEST_F(MissionDeskTest, TakesWithoutAServerWhatThatDoesNotKeep) {
  exchange::AgentStatus server;
  server.agent = AgentId("server");
  server.role = exchange::AgentRole::kServer;
  server.mode = exchange::AgentMode::kWaiting;
  server.on_duty = true;
  desk_->Handle(server);
  for (int times = 1; times < MissionDesk::kSentInVain; ++times) {
    desk_->Handle(For("m1"));
    desk_->Handle(For("kept"));
    ServerSays({.agent = AgentId("robot1"), .mission = "kept"});
    ServerSays({.agent = AgentId("robot1"), .mission = "m1", .state = State::kPutOff});
    EXPECT_THAT(Due(), IsEmpty());
  }
  desk_->Handle(For("kept"));
  EXPECT_THAT(Due(), IsEmpty());
  EXPECT_EQ(Answer(For("m1")).state, State::kAccepted);
}

TEST_F(MissionDeskTest, DoesItsTasksAndTheirLapsOneAfterTheOther) {
  (void)Answer(For("m1", "follow hall laps 2 wait 5"));
  EXPECT_EQ(desk_->current()->task, 0U);
  desk_->NoteDone();
  EXPECT_EQ(desk_->current()->task, 0U);
  EXPECT_EQ(desk_->current()->lap, 1U);
  Restart();
  ASSERT_TRUE(desk_->current());
  EXPECT_TRUE(desk_->current()->begun);
  EXPECT_EQ(desk_->current()->lap, 1U) << "remembered";
  desk_->NoteDone();
  EXPECT_EQ(desk_->current()->task, 1U);
  EXPECT_FALSE(desk_->current()->begun);
  desk_->NoteDone();
  EXPECT_EQ(desk_->current()->task, desk_->current()->tasks.size());
}

TEST_F(MissionDeskTest, RemembersWhatIsUnderWay) {
  Mission mission = For("m1");
  mission.goes_on = true;
  (void)Answer(mission);
  desk_->Tell(State::kUnderWay);
  Restart();
  ASSERT_TRUE(desk_->current());
  EXPECT_EQ(desk_->current()->mission, mission);
  desk_->Tell(State::kPaused, "its agent has started again");
  EXPECT_EQ(Due().back().change, 3U) << "it counts on";
}

TEST_F(MissionDeskTest, SaysItUntilAServerHasIt) {
  const Report accepted = Answer(For("m1"));
  EXPECT_THAT(Due(false), IsEmpty()) << "nobody would keep it";
  EXPECT_THAT(Due(true), SizeIs(1));
  EXPECT_THAT(Due(true), IsEmpty()) << "not at once again";
  now_ += seconds(1);
  EXPECT_THAT(Due(true), SizeIs(1));
  desk_->Tell(State::kUnderWay);
  (void)Due(true);
  ServerSays(accepted);
  now_ += seconds(1);
  EXPECT_THAT(Due(true), SizeIs(1)) << "the server has what was before";
  Report last = accepted;
  last.change = 2;
  desk_->Handle(last);
  now_ += seconds(1);
  EXPECT_THAT(Due(true), SizeIs(1)) << "said by no server";
  ServerSays(last);
  now_ += seconds(1);
  EXPECT_THAT(Due(true), IsEmpty());
}

Report SaidOf(const std::string& id, std::uint32_t change, State state) {
  return {.agent = AgentId("robot1"), .mission = id, .change = change, .state = state};
}

TEST_F(MissionDeskTest, WhatItsLostDiskHadOfAMissionHasFailed) {
  ServerSays(SaidOf("m1", 7, State::kUnderWay));
  for (int times = 0; times < 2; ++times) {
    const auto ends = Due();
    ASSERT_THAT(ends, SizeIs(1));
    EXPECT_EQ(ends[0].mission, "m1");
    EXPECT_EQ(ends[0].change, 8U) << "newer than what the server has";
    EXPECT_EQ(ends[0].state, State::kFailed);
    EXPECT_FALSE(ends[0].relayed);
    EXPECT_THAT(ends[0].detail, HasSubstr("without any record"));
    EXPECT_THAT(Due(true), IsEmpty());
    ServerSays(SaidOf("m1", 7, State::kUnderWay));  // has not heard it
  }
  (void)Due();
  for (const State state : {State::kArrived, State::kFailed, State::kCancelled}) {
    ServerSays(SaidOf("m1", 8, state));
  }
  ServerSays(SaidOf("m2", 0, State::kSent));
  ServerSays(SaidOf("m3", 0xFFFFFFFF, State::kUnderWay));
  desk_->Handle(SaidOf("m4", 7, State::kUnderWay));  // no server's word
  EXPECT_THAT(Due(), IsEmpty());
  EXPECT_FALSE(desk_->current());
}

TEST_F(MissionDeskTest, WhoeverHasAnOlderDiskHearsWhatIsSo) {
  (void)Answer(For("m1"));
  desk_->Tell(State::kUnderWay);
  const Report under_way = Due().at(0);
  ServerSays(under_way);
  EXPECT_THAT(Due(true), IsEmpty());
  ServerSays(SaidOf("m1", 1, State::kAccepted));
  ASSERT_EQ(Due(), std::vector<Report>{under_way}) << "the server's is older";

  ServerSays(SaidOf("m1", 9, State::kArrived));
  const auto again = Due();
  ASSERT_THAT(again, SizeIs(1)) << "the robot's is older";
  EXPECT_EQ(again[0].change, 10U);
  EXPECT_EQ(again[0].state, State::kUnderWay) << "it is what it does";
  ASSERT_TRUE(desk_->current());
  Restart();
  EXPECT_EQ(Due().at(0).change, 10U);
}

TEST_F(MissionDeskTest, AServerSendsItAnotherWayToTheSamePlace) {
  const auto way = [](const std::string& orders, bool relayed = true) {
    Mission mission = For("m1", orders);
    mission.relayed = relayed;
    return mission;
  };
  desk_->Handle(way("goto bay way 2 follow hall 0..1"));
  EXPECT_FALSE(desk_->current()) << "it has not begun, or has forgotten that it has";
  (void)Answer(way("goto bay follow hall 0..2 follow office 0..1", false));
  desk_->Tell(State::kUnderWay);
  desk_->NoteDone();
  (void)Due();
  const std::string round = "goto bay way 3 follow hall 1..1.5 follow yard 0..2 because it was so";
  const Report amended = Answer(way(round));
  EXPECT_EQ(amended.state, State::kUnderWay);
  EXPECT_EQ(amended.detail, "re-planned: it was so (way 3)");
  EXPECT_EQ(amended.way, 3U);
  EXPECT_EQ(amended.task, 0U);
  EXPECT_TRUE(desk_->TakeAmended());
  EXPECT_FALSE(desk_->TakeAmended());
  EXPECT_EQ(desk_->current()->going.because, "it was so");
  EXPECT_EQ(desk_->current()->tasks.at(1).route.route, "yard");
  desk_->GoOnAt(1);
  Restart();
  ASSERT_TRUE(desk_->current());
  EXPECT_EQ(desk_->current()->mission.orders, round);
  EXPECT_EQ(desk_->current()->task, 1U);
  for (const auto& [orders, relayed] :
       {std::pair{"goto bay way 3 follow hall 0..1", true},
        std::pair{"goto bay way 2 follow hall 0..1", true},
        std::pair{"goto bay follow hall 0..2 follow office 0..1", false},
        std::pair{"goto bay way 4 follow hall 0..1", false},
        std::pair{"goto dock way 4 follow hall 0..1", true}, std::pair{"follow hall", true}}) {
    desk_->Handle(way(orders, relayed));
    EXPECT_FALSE(desk_->TakeAmended()) << orders;
    EXPECT_EQ(desk_->current()->mission.orders, round) << orders;
  }
  desk_->Tell(State::kArrived);
  desk_->Handle(way("goto bay way 4 follow hall 0..1"));
  EXPECT_FALSE(desk_->current()) << "it is over";
}

TEST_F(MissionDeskTest, WhetherItIsQueuedOrAdmittedIsNotReadInWords) {
  using Why = mission::Going::Why;
  (void)Answer(For("m1", "goto bay follow hall 0..2"));
  const auto why = [&](const std::string& way) {
    Mission mission = For("m1", "goto bay " + way);
    mission.relayed = true;
    EXPECT_EQ(Answer(mission).waits_for, mission::WaitsFor::kNothing);
    return desk_->current()->going.why;
  };
  EXPECT_EQ(why("way 2 queued wait lane follow hall 0..2 because xyzzy"), Why::kQueued);
  desk_->Tell(State::kFetching, "xyzzy", mission::WaitsFor::kLane);
  EXPECT_EQ(Due().back().waits_for, mission::WaitsFor::kLane);
  Restart();
  const Report remembered = Due().back();
  EXPECT_EQ(remembered.waits_for, mission::WaitsFor::kLane);
  EXPECT_EQ(remembered.way, 2U);
  EXPECT_EQ(remembered.detail, "xyzzy (way 2)");
  EXPECT_EQ(why("way 3 admitted follow hall 0..2 because xyzzy"), Why::kAdmitted);
  EXPECT_EQ(why("way 4 follow hall 0..2 because waits for xyzzy"), Why::kReplanned);
  desk_->Tell(State::kUnderWay);
  EXPECT_EQ(Due().back().waits_for, mission::WaitsFor::kNothing);
}

TEST_F(MissionDeskTest, AnswersOthersNot) {
  Mission mission = For("m1");
  mission.agent = AgentId("robot2");
  desk_->Handle(mission);
  EXPECT_THAT(Due(), IsEmpty());
  EXPECT_FALSE(desk_->current());
}

TEST_F(MissionDeskTest, WhatItCannotRememberItDoesNot) {
  desk_.emplace(AgentId("robot1"), folder_ / "nowhere" / "missions");
  const Report refused = Answer(For("m1"));
  EXPECT_EQ(refused.state, State::kRefused);
  EXPECT_THAT(refused.detail, HasSubstr("nowhere"));
  EXPECT_FALSE(desk_->current());
}

TEST_F(MissionDeskTest, ForgetsTheOldestThatHaveEnded) {
  (void)Answer(For("current"));
  for (std::size_t i = 0; i < 2 * MissionDesk::kMostKept; ++i) {
    EXPECT_EQ(Answer(For("m" + std::to_string(i))).state, State::kRefused);
  }
  Restart();
  ASSERT_TRUE(desk_->current());
  EXPECT_EQ(desk_->current()->mission.id, "current");
}

TEST_F(MissionDeskTest, AFileThatIsSomebodyElsesIsNotTaken) {
  for (const char* text :
       {"nonsense\n", "trailcast-missions 1\n", "trailcast-missions 2\nm1\tdesk\n",
        "trailcast-missions 2\nm1\tdesk\t0\t1\t99\t0\t1\t0\t0\t0\twait 1\t\n",
        "trailcast-missions 2\nm1\tdesk\t0\t1\t4\t7\t1\t0\t0\t0\twait 1\t\n",
        "trailcast-missions 2\nm1\tdesk\t0\t1\t4\t0\t1\t9\t0\t0\twait 1\t\n",
        "trailcast-missions 2\nm 1\tdesk\t0\t1\t6\t0\t1\t0\t0\t0\twait 1\t\n",
        "trailcast-missions 2\nm1\tdesk\t0\t1\t4\t0\t1\t0\t0\t0\twait 1\t\n"
        "m2\tdesk\t0\t1\t4\t0\t1\t0\t0\t0\twait 1\t\n"}) {
    std::ofstream(folder_ / "missions") << text;
    MissionDesk desk(AgentId("robot1"), folder_ / "missions");
    const auto loaded = desk.Load();
    ASSERT_FALSE(loaded) << text;
    EXPECT_EQ(loaded.error().code, ErrorCode::kCorrupt);
  }
}

}  // namespace
}  // namespace trailcast::agent
