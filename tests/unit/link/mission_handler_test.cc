#include "agent/link/mission_handler.h"

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

class MissionHandlerTest : public testing::Test {
 protected:
  void SetUp() override { Restart(); }
  void Restart() {
    handler_.emplace(AgentId("robot1"), folder_ / "missions");
    ASSERT_TRUE(handler_->Load());
  }
  static Mission For(const std::string& id, const std::string& orders = "follow hall") {
    return {.agent = AgentId("robot1"), .id = id, .client = AgentId("desk-p7"), .orders = orders};
  }
  std::vector<Report> Due(bool server_there = false) {
    std::vector<Report> reports;
    for (const exchange::Message& message : handler_->Due(now_, server_there)) {
      reports.push_back(std::get<Report>(message));
    }
    return reports;
  }
  Report Answer(const Mission& mission) {
    handler_->Handle(mission);
    const auto reports = Due();
    EXPECT_THAT(reports, SizeIs(1));
    return reports.empty() ? Report{} : reports.back();
  }
  void ServerSays(Report report) {
    report.relayed = true;
    handler_->Handle(report);
  }

  test::TempDir folder_;
  std::chrono::steady_clock::time_point now_{seconds(100)};
  std::optional<MissionHandler> handler_;
};

TEST_F(MissionHandlerTest, TakesAMissionAndTellsWhatBecomesOfIt) {
  const Report accepted = Answer(For("m1"));
  EXPECT_EQ(accepted.state, State::kAccepted);
  EXPECT_EQ(accepted.change, 1U);
  ASSERT_TRUE(handler_->current());
  EXPECT_EQ(handler_->current()->mission.id, "m1");
  handler_->Tell(State::kUnderWay);
  EXPECT_EQ(Due().at(0).change, 2U);
  handler_->NoteDone();
  handler_->Tell(State::kArrived);
  EXPECT_EQ(Due().at(0).state, State::kArrived);
  EXPECT_FALSE(handler_->current());
}

TEST_F(MissionHandlerTest, TheSameOneIsDoneOnceAlsoAfterARestart) {
  (void)Answer(For("m1"));
  handler_->NoteDone();
  handler_->Tell(State::kArrived);
  (void)Due();
  EXPECT_EQ(Answer(For("m1")).state, State::kArrived);
  EXPECT_FALSE(handler_->current());
  Restart();
  (void)Due();
  EXPECT_EQ(Answer(For("m1")).state, State::kArrived);
  EXPECT_FALSE(handler_->current());
}

TEST_F(MissionHandlerTest, RefusesASecondOneAndWhatItDoesNotUnderstand) {
  EXPECT_EQ(Answer(For("m0", "dance")).state, State::kRefused);
  (void)Answer(For("m1"));
  const Report refused = Answer(For("m2", "follow yard"));
  EXPECT_EQ(refused.state, State::kRefused);
  EXPECT_THAT(refused.detail, HasSubstr("busy with mission m1: follow hall"));
  EXPECT_EQ(handler_->current()->mission.id, "m1");
}

TEST_F(MissionHandlerTest, WhereAServerKeepsMissionsItTakesOneWhenThatHandsItOver) {
  exchange::AgentStatus server;
  server.agent = AgentId("server");
  server.instance = 5;
  server.role = exchange::AgentRole::kServer;
  server.mode = exchange::AgentMode::kWaiting;
  handler_->Handle(server);
  EXPECT_EQ(Answer(For("m0", "wait 1")).state, State::kAccepted) << "that one keeps none";
  handler_->Tell(State::kArrived);
  (void)Due();
  server.on_duty = true;
  handler_->Handle(server);
  Mission first = For("m1");
  Mission second = For("m2", "follow yard");
  for (Mission* mission : {&first, &second}) {
    handler_->Handle(*mission);
    EXPECT_THAT(Due(), IsEmpty());
    mission->relayed = true;
  }
  EXPECT_EQ(Answer(first).state, State::kAccepted);
  handler_->Handle(second);
  EXPECT_THAT(Due(), IsEmpty()) << "it is handed over again";
  handler_->Tell(State::kArrived);
  (void)Due();
  EXPECT_EQ(Answer(second).state, State::kAccepted);
  handler_->Tell(State::kArrived);
  (void)Due();
  handler_->Handle(exchange::AgentGone{server.agent, server.instance});
  EXPECT_EQ(Answer(For("m3")).state, State::kAccepted) << "there is no such server any more";
}

TEST_F(MissionHandlerTest, TakesWithoutAServerWhatThatDoesNotKeep) {
  exchange::AgentStatus server;
  server.agent = AgentId("server");
  server.role = exchange::AgentRole::kServer;
  server.mode = exchange::AgentMode::kWaiting;
  server.on_duty = true;
  handler_->Handle(server);
  for (int times = 1; times < MissionHandler::kSentInVain; ++times) {
    handler_->Handle(For("m1"));
    handler_->Handle(For("kept"));
    ServerSays({.agent = AgentId("robot1"), .mission = "kept"});
    ServerSays({.agent = AgentId("robot1"), .mission = "m1", .state = State::kPutOff});
    EXPECT_THAT(Due(), IsEmpty());
  }
  handler_->Handle(For("kept"));
  EXPECT_THAT(Due(), IsEmpty());
  EXPECT_EQ(Answer(For("m1")).state, State::kAccepted);
}

TEST_F(MissionHandlerTest, DoesItsTasksAndTheirLapsOneAfterTheOther) {
  (void)Answer(For("m1", "follow hall laps 2 wait 5"));
  EXPECT_EQ(handler_->current()->task, 0U);
  handler_->NoteDone();
  EXPECT_EQ(handler_->current()->task, 0U);
  EXPECT_EQ(handler_->current()->lap, 1U);
  Restart();
  ASSERT_TRUE(handler_->current());
  EXPECT_TRUE(handler_->current()->begun);
  EXPECT_EQ(handler_->current()->lap, 1U) << "remembered";
  handler_->NoteDone();
  EXPECT_EQ(handler_->current()->task, 1U);
  EXPECT_FALSE(handler_->current()->begun);
  handler_->NoteDone();
  EXPECT_EQ(handler_->current()->task, handler_->current()->tasks.size());
}

TEST_F(MissionHandlerTest, RemembersWhatIsUnderWay) {
  Mission mission = For("m1");
  mission.goes_on = true;
  (void)Answer(mission);
  handler_->Tell(State::kUnderWay);
  Restart();
  ASSERT_TRUE(handler_->current());
  EXPECT_EQ(handler_->current()->mission, mission);
  handler_->Tell(State::kPaused, "its agent has started again");
  EXPECT_EQ(Due().back().change, 3U) << "it counts on";
}

TEST_F(MissionHandlerTest, SaysItUntilAServerHasIt) {
  const Report accepted = Answer(For("m1"));
  EXPECT_THAT(Due(false), IsEmpty()) << "nobody would keep it";
  EXPECT_THAT(Due(true), SizeIs(1));
  EXPECT_THAT(Due(true), IsEmpty()) << "not at once again";
  now_ += seconds(1);
  EXPECT_THAT(Due(true), SizeIs(1));
  handler_->Tell(State::kUnderWay);
  (void)Due(true);
  ServerSays(accepted);
  now_ += seconds(1);
  EXPECT_THAT(Due(true), SizeIs(1)) << "the server has what was before";
  Report last = accepted;
  last.change = 2;
  handler_->Handle(last);
  now_ += seconds(1);
  EXPECT_THAT(Due(true), SizeIs(1)) << "said by no server";
  ServerSays(last);
  now_ += seconds(1);
  EXPECT_THAT(Due(true), IsEmpty());
}

Report SaidOf(const std::string& id, std::uint32_t change, State state) {
  return {.agent = AgentId("robot1"), .mission = id, .change = change, .state = state};
}

TEST_F(MissionHandlerTest, WhatItsLostDiskHadOfAMissionHasFailed) {
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
  handler_->Handle(SaidOf("m4", 7, State::kUnderWay));  // no server's word
  EXPECT_THAT(Due(), IsEmpty());
  EXPECT_FALSE(handler_->current());
}

TEST_F(MissionHandlerTest, WhoeverHasAnOlderDiskHearsWhatIsSo) {
  (void)Answer(For("m1"));
  handler_->Tell(State::kUnderWay);
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
  ASSERT_TRUE(handler_->current());
  Restart();
  EXPECT_EQ(Due().at(0).change, 10U);
}

TEST_F(MissionHandlerTest, AServerSendsItAnotherWayToTheSamePlace) {
  const auto way = [](const std::string& orders, bool relayed = true) {
    Mission mission = For("m1", orders);
    mission.relayed = relayed;
    return mission;
  };
  handler_->Handle(way("goto bay way 2 follow hall 0..1"));
  EXPECT_FALSE(handler_->current()) << "it has not begun, or has forgotten that it has";
  (void)Answer(way("goto bay follow hall 0..2 follow office 0..1", false));
  handler_->Tell(State::kUnderWay);
  handler_->NoteDone();
  (void)Due();
  const std::string round = "goto bay way 3 follow hall 1..1.5 follow yard 0..2 because it was so";
  const Report amended = Answer(way(round));
  EXPECT_EQ(amended.state, State::kUnderWay);
  EXPECT_EQ(amended.detail, "re-planned: it was so (way 3)");
  EXPECT_EQ(amended.way, 3U);
  EXPECT_EQ(amended.task, 0U);
  EXPECT_TRUE(handler_->TakeAmended());
  EXPECT_FALSE(handler_->TakeAmended());
  EXPECT_EQ(handler_->current()->going.because, "it was so");
  EXPECT_EQ(handler_->current()->tasks.at(1).route.route, "yard");
  handler_->GoOnAt(1);
  Restart();
  ASSERT_TRUE(handler_->current());
  EXPECT_EQ(handler_->current()->mission.orders, round);
  EXPECT_EQ(handler_->current()->task, 1U);
  for (const auto& [orders, relayed] :
       {std::pair{"goto bay way 3 follow hall 0..1", true},
        std::pair{"goto bay way 2 follow hall 0..1", true},
        std::pair{"goto bay follow hall 0..2 follow office 0..1", false},
        std::pair{"goto bay way 4 follow hall 0..1", false},
        std::pair{"goto dock way 4 follow hall 0..1", true}, std::pair{"follow hall", true}}) {
    handler_->Handle(way(orders, relayed));
    EXPECT_FALSE(handler_->TakeAmended()) << orders;
    EXPECT_EQ(handler_->current()->mission.orders, round) << orders;
  }
  handler_->Tell(State::kArrived);
  handler_->Handle(way("goto bay way 4 follow hall 0..1"));
  EXPECT_FALSE(handler_->current()) << "it is over";
}

TEST_F(MissionHandlerTest, WhetherItIsQueuedOrAdmittedIsNotReadInWords) {
  using Why = mission::Going::Why;
  (void)Answer(For("m1", "goto bay follow hall 0..2"));
  const auto why = [&](const std::string& way) {
    Mission mission = For("m1", "goto bay " + way);
    mission.relayed = true;
    EXPECT_EQ(Answer(mission).waits_for, mission::WaitsFor::kNothing);
    return handler_->current()->going.why;
  };
  EXPECT_EQ(why("way 2 queued wait lane follow hall 0..2 because xyzzy"), Why::kQueued);
  handler_->Tell(State::kFetching, "xyzzy", mission::WaitsFor::kLane);
  EXPECT_EQ(Due().back().waits_for, mission::WaitsFor::kLane);
  Restart();
  const Report remembered = Due().back();
  EXPECT_EQ(remembered.waits_for, mission::WaitsFor::kLane);
  EXPECT_EQ(remembered.way, 2U);
  EXPECT_EQ(remembered.detail, "xyzzy (way 2)");
  EXPECT_EQ(why("way 3 admitted follow hall 0..2 because xyzzy"), Why::kAdmitted);
  EXPECT_EQ(why("way 4 follow hall 0..2 because waits for xyzzy"), Why::kReplanned);
  handler_->Tell(State::kUnderWay);
  EXPECT_EQ(Due().back().waits_for, mission::WaitsFor::kNothing);
}

TEST_F(MissionHandlerTest, AMissionThatEndedBecauseItsRobotIsLostTellsThatAfterARestartToo) {
  (void)Answer(For("m1"));
  handler_->Tell(State::kFailed, "xyzzy", mission::WaitsFor::kPlace);
  EXPECT_EQ(Due().back().waits_for, mission::WaitsFor::kPlace);
  Restart();
  const Report remembered = Due().back();
  EXPECT_EQ(remembered.state, State::kFailed);
  EXPECT_EQ(remembered.waits_for, mission::WaitsFor::kPlace);
}

TEST_F(MissionHandlerTest, AnswersOthersNot) {
  Mission mission = For("m1");
  mission.agent = AgentId("robot2");
  handler_->Handle(mission);
  EXPECT_THAT(Due(), IsEmpty());
  EXPECT_FALSE(handler_->current());
}

TEST_F(MissionHandlerTest, WhatItCannotRememberItDoesNot) {
  handler_.emplace(AgentId("robot1"), folder_ / "nowhere" / "missions");
  const Report refused = Answer(For("m1"));
  EXPECT_EQ(refused.state, State::kRefused);
  EXPECT_THAT(refused.detail, HasSubstr("nowhere"));
  EXPECT_FALSE(handler_->current());
}

TEST_F(MissionHandlerTest, ForgetsTheOldestThatHaveEnded) {
  (void)Answer(For("current"));
  for (std::size_t i = 0; i < 2 * MissionHandler::kMostKept; ++i) {
    EXPECT_EQ(Answer(For("m" + std::to_string(i))).state, State::kRefused);
  }
  Restart();
  ASSERT_TRUE(handler_->current());
  EXPECT_EQ(handler_->current()->mission.id, "current");
}

TEST_F(MissionHandlerTest, AFileThatIsSomebodyElsesIsNotTaken) {
  for (const char* text :
       {"nonsense\n", "trailcast-missions 1\n", "trailcast-missions 2\nm1\tdesk\n",
        "trailcast-missions 2\nm1\tdesk\t0\t1\t99\t0\t1\t0\t0\t0\twait 1\t\n",
        "trailcast-missions 2\nm1\tdesk\t0\t1\t4\t7\t1\t0\t0\t0\twait 1\t\n",
        "trailcast-missions 2\nm1\tdesk\t0\t1\t4\t0\t1\t9\t0\t0\twait 1\t\n",
        "trailcast-missions 2\nm 1\tdesk\t0\t1\t6\t0\t1\t0\t0\t0\twait 1\t\n",
        "trailcast-missions 2\nm1\tdesk\t0\t1\t4\t0\t1\t0\t0\t0\twait 1\t\n"
        "m2\tdesk\t0\t1\t4\t0\t1\t0\t0\t0\twait 1\t\n"}) {
    std::ofstream(folder_ / "missions") << text;
    MissionHandler handler(AgentId("robot1"), folder_ / "missions");
    const auto loaded = handler.Load();
    ASSERT_FALSE(loaded) << text;
    EXPECT_EQ(loaded.error().code, ErrorCode::kCorrupt);
  }
}

}  // namespace
}  // namespace trailcast::agent
