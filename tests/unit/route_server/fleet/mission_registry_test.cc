#include "route_server/fleet/mission_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "tests/support/temp_dir.h"

namespace trailcast::server {
namespace {

using exchange::NowOrder;
using exchange::NowWhom;
using mission::Mission;
using mission::Report;
using mission::State;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class MissionRegistryTest : public testing::Test {
 protected:
  void SetUp() override { Restart(); }
  void Restart() {
    registry_.reset();
    auto store = store::MissionStore::Open(folder_ / "missions");
    ASSERT_TRUE(store) << store.error().message;
    auto registry = MissionRegistry::Open(AgentId("server"), std::move(*store));
    ASSERT_TRUE(registry) << registry.error().message;
    registry_ = std::move(*registry);
  }
  static Mission For(const std::string& id, const std::string& orders = "follow hall") {
    return {.agent = AgentId("robot1"),
            .id = id,
            .client = AgentId("desk-p7"),
            .orders = orders,
            .valid_for_s = 60};
  }
  void Hear(const exchange::Message& message) { registry_->Handle(message, now_, unix_ms_); }
  void Pass(milliseconds time) {
    now_ += time;
    unix_ms_ += time.count();
  }
  std::vector<exchange::Message> Say() { return registry_->Tick(now_, unix_ms_); }
  // Returns what it says of missions, and what it hands over.
  std::optional<Report> Said() {
    std::optional<Report> report;
    for (const exchange::Message& message : Say()) {
      if (const auto* said = std::get_if<Report>(&message)) report = *said;
    }
    return report;
  }
  std::optional<Mission> HandedOver() {
    for (const exchange::Message& message : Say()) {
      if (const auto* mission = std::get_if<Mission>(&message)) return *mission;
    }
    return std::nullopt;
  }
  void RobotIsThere(std::uint64_t instance = 1,
                    exchange::AgentHold hold = exchange::AgentHold::kNone) {
    exchange::AgentStatus status;
    status.hold = hold;
    if (hold != exchange::AgentHold::kNone) status.detail = "held by desk";
    status.agent = AgentId("robot1");
    status.instance = instance;
    status.role = exchange::AgentRole::kFollower;
    status.mode = exchange::AgentMode::kWaiting;
    Hear(status);
  }
  void RobotSays(const std::string& id, std::uint32_t change, State state) {
    Hear(Report{.agent = AgentId("robot1"), .mission = id, .change = change, .state = state});
  }
  State StateOf(const std::string& id) { return LastOf(id).state; }
  std::string WaitsFor(const std::string& id) {
    const Report last = LastOf(id);
    EXPECT_EQ(last.waits_for == mission::WaitsFor::kTurn, !last.detail.empty());
    return last.detail;
  }
  void Tell(NowOrder order, NowWhom whom = NowWhom::kRobot, const std::string& name = "robot1") {
    Hear(exchange::NowCommand{.client = AgentId("desk-p9"),
                              .number = ++commands_,
                              .order = order,
                              .whom = whom,
                              .name = name});
  }
  Report LastOf(const std::string& id) {
    (void)Say();
    Hear(exchange::MissionRequest{.client = AgentId("desk"), .request = 7, .query = {.id = id}});
    for (const exchange::Message& message : Say()) {
      const auto* reply = std::get_if<exchange::MissionReply>(&message);
      if (reply == nullptr) continue;
      EXPECT_EQ(reply->client, AgentId("desk"));
      EXPECT_EQ(reply->request, 7U);
      EXPECT_THAT(reply->missions, SizeIs(1));
      return reply->missions.empty() ? Report{} : reply->missions[0].last;
    }
    ADD_FAILURE() << "no reply";
    return {};
  }

  test::TempDir folder_;
  std::chrono::steady_clock::time_point now_{};
  std::int64_t unix_ms_ = 1'700'000'000'000;
  std::unique_ptr<MissionRegistry> registry_;
  std::uint64_t commands_ = 0;
};

TEST_F(MissionRegistryTest, SaysThatItKeepsAMissionEachTimeThatItIsSent) {
  Hear(For("m1"));
  const auto kept = Said();
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->state, State::kSent);
  EXPECT_TRUE(kept->relayed);
  Hear(For("m1"));
  EXPECT_TRUE(Said());
  EXPECT_EQ(registry_->unanswered(), 1U);
  EXPECT_THAT(registry_->TakeNotes(), SizeIs(1)) << "it is news once";
}

TEST_F(MissionRegistryTest, HandsItOverOnceTheRobotIsThereAndUntilItHasAnswered) {
  Hear(For("m1"));
  EXPECT_FALSE(HandedOver()) << "to nobody";
  RobotIsThere();
  const auto handed = HandedOver();
  ASSERT_TRUE(handed);
  EXPECT_EQ(handed->id, "m1");
  EXPECT_TRUE(handed->relayed);
  EXPECT_FALSE(HandedOver()) << "at once again";
  Pass(milliseconds(1100));
  EXPECT_TRUE(HandedOver());
  RobotSays("m1", 1, State::kAccepted);
  const auto confirmed = Said();
  ASSERT_TRUE(confirmed);
  EXPECT_EQ(confirmed->change, 1U);
  EXPECT_TRUE(confirmed->relayed);
  Pass(seconds(100));
  EXPECT_FALSE(HandedOver());
  EXPECT_EQ(StateOf("m1"), State::kAccepted);
}

TEST_F(MissionRegistryTest, KeepsItOverARestart) {
  Hear(For("m1"));
  Restart();
  RobotIsThere();
  const auto handed = HandedOver();
  ASSERT_TRUE(handed);
  EXPECT_EQ(handed->orders, "follow hall");
  RobotSays("m1", 1, State::kAccepted);
  Restart();
  RobotIsThere();
  EXPECT_FALSE(HandedOver());
  EXPECT_EQ(StateOf("m1"), State::kAccepted);
}

TEST_F(MissionRegistryTest, ABusyRobotsMissionsQueueAndEachSaysWhatItWaitsFor) {
  Hear(For("m1"));
  Hear(For("m2", "follow yard"));
  EXPECT_THAT(WaitsFor("m1"), HasSubstr("not heard"));
  RobotIsThere();
  EXPECT_EQ(HandedOver()->id, "m1");
  EXPECT_EQ(WaitsFor("m1"), "");
  EXPECT_THAT(WaitsFor("m2"), HasSubstr("mission m1 comes before: follow hall"));
  RobotSays("m1", 1, State::kUnderWay);
  EXPECT_THAT(WaitsFor("m2"), HasSubstr("it does mission m1: follow hall"));
  EXPECT_FALSE(HandedOver());
}

TEST_F(MissionRegistryTest, TheNextOneIsHandedOverAtOnceWhenTheOneBeforeHasArrived) {
  Hear(For("m1"));
  Hear(For("m2", "follow yard"));
  RobotIsThere();
  RobotSays("m1", 1, State::kUnderWay);
  for (int restarts = 0; restarts < 2; ++restarts) {
    EXPECT_THAT(WaitsFor("m2"), HasSubstr("it does mission m1: follow hall"));
    Pass(seconds(100));
    EXPECT_FALSE(HandedOver()) << "nor has it expired: its robot is not out of reach";
    Restart();
    RobotIsThere(2);
  }
  RobotSays("m1", 2, State::kArrived);
  const auto handed = HandedOver();
  ASSERT_TRUE(handed);
  EXPECT_EQ(handed->id, "m2");
}

// "follow yard" begins at the yard, where m1 was to end.
TEST_F(MissionRegistryTest, AQueueIsHeldAfterAMissionThatHasNotArrivedUntilItsRobotIsToldToResume) {
  for (const State end : {State::kFailed, State::kRefused, State::kCancelled}) {
    const std::string id = mission::ToString(end);
    Hear(For(id));
    Hear(For(id + "-next", "follow yard"));
    Hear(For(id + "-last", "follow yard"));
    RobotIsThere();
    RobotSays(id, 1, State::kUnderWay);
    RobotSays(id, 2, end);
    for (int restarts = 0; restarts < 2; ++restarts) {
      EXPECT_THAT(WaitsFor(id + "-next"),
                  HasSubstr("mission " + id + " did not arrive (" + id + ")"));
      EXPECT_THAT(WaitsFor(id + "-last"), HasSubstr("mission " + id + "-next comes before"));
      Pass(seconds(100));
      EXPECT_FALSE(HandedOver());
      Restart();
      RobotIsThere();
    }
    Tell(NowOrder::kResume, NowWhom::kRobot, "robot2");
    EXPECT_FALSE(HandedOver());
    Tell(NowOrder::kResume);
    EXPECT_EQ(HandedOver()->id, id + "-next");
    RobotSays(id, 2, end);
    Restart();
    RobotIsThere();
    EXPECT_EQ(HandedOver()->id, id + "-next") << "an end that is repeated holds nothing anew";
    RobotSays(id + "-next", 1, State::kArrived);
    RobotSays(id + "-last", 1, State::kArrived);
    (void)Say();
  }
}

TEST_F(MissionRegistryTest, AQueueIsHeldAfterOneThatExpired) {
  Hear(For("m1"));
  Mission later = For("m2", "follow yard");
  later.valid_for_s = 600;
  Hear(later);
  (void)Say();
  Pass(seconds(61));
  EXPECT_EQ(StateOf("m1"), State::kExpired);
  RobotIsThere();
  EXPECT_FALSE(HandedOver());
  EXPECT_THAT(WaitsFor("m2"), HasSubstr("mission m1 did not arrive (expired)"));
}

TEST_F(MissionRegistryTest, OneThatExpiresHoldsNoneThatCameBeforeIt) {
  Mission first = For("m1");
  first.valid_for_s = 600;
  Hear(first);
  Hear(For("m2", "follow yard"));
  (void)Say();
  Pass(seconds(61));
  EXPECT_EQ(StateOf("m2"), State::kExpired);
  RobotIsThere();
  EXPECT_EQ(HandedOver()->id, "m1");
}

TEST_F(MissionRegistryTest, WhatARobotTookWithoutThisServerComesFirst) {
  RobotIsThere();
  RobotSays("other", 2, State::kUnderWay);
  Hear(For("m1"));
  EXPECT_FALSE(HandedOver());
  EXPECT_THAT(WaitsFor("m1"), HasSubstr("it does mission other"));
  RobotSays("other", 3, State::kFailed);
  EXPECT_EQ(HandedOver()->id, "m1") << "it was sent without regard to that one";
}

TEST_F(MissionRegistryTest, WhatWaitsForARobotThatIsOutOfReachWithAMissionIsKeptForLong) {
  Hear(For("m1"));
  Hear(For("m2", "follow yard"));
  RobotIsThere();
  RobotSays("m1", 1, State::kUnderWay);
  (void)Say();
  Hear(exchange::AgentGone{AgentId("robot1"), 1});
  for (int restarts = 0; restarts < 2; ++restarts) {
    Pass(std::chrono::hours(24));
    EXPECT_EQ(StateOf("m2"), State::kSent);
    Restart();
  }
  (void)Say();
  RobotSays("m1", 2, State::kArrived);
  Pass(seconds(1));
  EXPECT_EQ(StateOf("m2"), State::kSent);
  Pass(seconds(60));
  EXPECT_EQ(StateOf("m2"), State::kExpired) << "it could have taken that, and was not heard";
}

TEST_F(MissionRegistryTest, SaysAnewWhatItWaitsForAsThatChanges) {
  const auto told = [this] {
    std::string detail;
    for (const exchange::Message& message : Say()) {
      const auto* report = std::get_if<Report>(&message);
      if (report != nullptr && report->mission == "m1") detail = report->detail;
    }
    return detail;
  };
  Hear(For("m1"));
  EXPECT_THAT(told(), HasSubstr("not heard"));
  EXPECT_EQ(told(), "");
  RobotIsThere(1, exchange::AgentHold::kPaused);
  EXPECT_THAT(told(), HasSubstr("held by desk"));
  EXPECT_FALSE(HandedOver()) << "nothing is handed to who is held";
  Hear(For("m1"));
  EXPECT_THAT(told(), HasSubstr("held by desk")) << "whoever sends it again hears it again";
  RobotIsThere(1);
  EXPECT_TRUE(HandedOver());
}

TEST_F(MissionRegistryTest, AStopHoldsTheQueueOfARobotThatHasNotHeardItUntilItIsToldToResume) {
  Hear(For("m1"));
  Hear(For("m2", "follow yard"));
  Pass(seconds(1));
  Tell(NowOrder::kStop, NowWhom::kRobot, "robot2");
  EXPECT_THAT(WaitsFor("m1"), HasSubstr("not heard"));
  Tell(NowOrder::kStop, NowWhom::kOnRoute, "yard");
  unix_ms_ -= 86'400'000;  // the clock is set back
  for (int restarts = 0; restarts < 2; ++restarts) {
    RobotIsThere(1);
    EXPECT_FALSE(HandedOver());
    EXPECT_THAT(WaitsFor("m1"), HasSubstr("stopped by desk on 2023-11-14 at 22:13:21 UTC"));
    Tell(NowOrder::kResume, NowWhom::kRobot, "robot2");
    Restart();
  }
  RobotIsThere(1);
  Tell(NowOrder::kRelease);
  EXPECT_FALSE(HandedOver()) << "a robot that is released stands until it is told to resume";
  Tell(NowOrder::kResume);
  RobotIsThere(1, exchange::AgentHold::kPaused);
  EXPECT_FALSE(HandedOver()) << "somebody has paused it";
  Restart();
  RobotIsThere(1);
  EXPECT_EQ(HandedOver()->id, "m1");
}

TEST_F(MissionRegistryTest, AHoldEndsWithItsQueue) {
  Hear(For("m1"));
  Tell(NowOrder::kStop);
  Tell(NowOrder::kCancel);
  (void)Say();
  Restart();
  RobotIsThere();
  Hear(For("m2"));
  EXPECT_EQ(HandedOver()->id, "m2");
}

TEST_F(MissionRegistryTest, ARobotThatIsBackIsToldAtOnce) {
  Hear(For("m1"));
  RobotIsThere();
  ASSERT_TRUE(HandedOver());
  for (int i = 0; i < 4; ++i) {
    Pass(seconds(2));
    (void)HandedOver();
  }
  Pass(milliseconds(100));
  ASSERT_FALSE(HandedOver());
  Hear(exchange::AgentGone{AgentId("robot1"), 1});
  RobotIsThere(2);
  EXPECT_TRUE(HandedOver());
}

// A robot that lost its disk knows of neither any more.
TEST_F(MissionRegistryTest, AsksARobotThatIsMetForAllThatItTookToBeUnderWay) {
  RobotIsThere(1);
  for (const char* id : {"m1", "m2"}) {
    Hear(For(id));
    RobotSays(id, 2, State::kUnderWay);
  }
  (void)Say();
  const auto asked = [this] {
    std::vector<std::string> ids;
    for (const exchange::Message& message : Say()) {
      const auto* report = std::get_if<Report>(&message);
      if (report == nullptr) continue;
      EXPECT_TRUE(report->relayed);
      EXPECT_EQ(report->change, 2U);
      ids.push_back(report->mission);
    }
    return ids;
  };
  using testing::ElementsAre;
  for (const bool server_restarts : {false, true}) {
    if (server_restarts) Restart();
    RobotIsThere(server_restarts ? 3 : 2);
    EXPECT_THAT(asked(), ElementsAre("m1", "m2"));
    EXPECT_THAT(asked(), IsEmpty());
    Pass(seconds(2));
    EXPECT_THAT(asked(), ElementsAre("m1", "m2")) << "it did not answer";
  }
  RobotSays("m1", 3, State::kFailed);
  EXPECT_EQ(StateOf("m1"), State::kFailed);
  RobotSays("m2", 3, State::kFailed);
  (void)Say();
  EXPECT_EQ(registry_->CurrentOf(AgentId("robot1")), nullptr);
  Pass(seconds(60));
  EXPECT_THAT(asked(), IsEmpty());
}

TEST_F(MissionRegistryTest, DropsWhatItCouldNotHandOverInTime) {
  Hear(For("m1"));
  (void)Say();
  Pass(seconds(61));
  const auto dropped = Said();
  ASSERT_TRUE(dropped);
  EXPECT_EQ(dropped->state, State::kExpired);
  RobotIsThere();
  EXPECT_FALSE(HandedOver());
  EXPECT_EQ(StateOf("m1"), State::kExpired);
}

TEST_F(MissionRegistryTest, AClockThatIsSetMakesNoneExpireNorLast) {
  Hear(For("m1"));
  (void)Say();
  unix_ms_ += 86'400'000;
  now_ += seconds(30);
  EXPECT_FALSE(Said());
  unix_ms_ -= 10 * std::int64_t{86'400'000};
  now_ += seconds(30);
  const auto dropped = Said();
  ASSERT_TRUE(dropped);
  EXPECT_EQ(dropped->state, State::kExpired);
}

TEST_F(MissionRegistryTest, NoneIsKeptForEverForARobotThatIsNotHeard) {
  Mission mission = For("m1");
  mission.valid_for_s = 0;
  Hear(mission);
  (void)Say();
  Pass(std::chrono::seconds(mission::kLongestValid_s - 1));
  EXPECT_FALSE(Said());
  Pass(std::chrono::seconds(1));
  ASSERT_TRUE(Said());
  EXPECT_EQ(StateOf("m1"), State::kExpired);
}

class GoingToPlaces : public MissionRegistryTest {
 protected:
  void Plan() {
    registry_->PlanBy([this](const AgentId& agent, const std::string& goal) -> Result<bool> {
      EXPECT_EQ(agent, AgentId("robot1"));
      goals_.push_back(goal);
      return way_;
    });
  }
  Result<bool> way_ = true;
  std::vector<std::string> goals_;
};

TEST_F(GoingToPlaces, OneThatWaitedIsToldThePathFromWhereItStandsThen) {
  const std::string orders = "goto bay follow hall 0..2";
  Plan();
  RobotIsThere();
  Hear(For("m1", orders));
  EXPECT_EQ(HandedOver()->orders, orders) << "it did not wait";
  RobotSays("m1", 1, State::kUnderWay);
  Hear(For("m2", orders));
  (void)Say();
  Hear(For("m2", orders));
  EXPECT_EQ(Said()->state, State::kSent) << "it is the same mission when its sender repeats it";
  EXPECT_THAT(goals_, IsEmpty());
  Restart();
  Plan();
  RobotIsThere();
  RobotSays("m1", 2, State::kArrived);
  EXPECT_EQ(HandedOver()->orders, "goto bay wait way");
  EXPECT_THAT(goals_, testing::ElementsAre("bay"));
}

TEST_F(GoingToPlaces, OneThatStandsThereByThenHasArrivedAndTheNextFollows) {
  Plan();
  way_ = false;
  RobotIsThere();
  Hear(For("m1"));
  Hear(For("m2", "goto bay follow hall 0..2"));
  Hear(For("m3", "follow yard"));
  RobotSays("m1", 1, State::kUnderWay);
  (void)Say();
  RobotSays("m1", 2, State::kArrived);
  EXPECT_FALSE(HandedOver());
  EXPECT_EQ(StateOf("m2"), State::kArrived);
  Pass(seconds(2));
  EXPECT_EQ(HandedOver()->id, "m3");
}

TEST_F(GoingToPlaces, OneWhosePlaceIsNotKnownByThenGoesNowhereAndTheRestIsHeld) {
  Plan();
  way_ = Fail(ErrorCode::kNotFound, "robot1 has not said where it stands");
  RobotIsThere();
  Hear(For("m1"));
  Hear(For("m2", "goto bay follow hall 0..2"));
  Hear(For("m3", "follow yard"));
  RobotSays("m1", 1, State::kUnderWay);
  (void)Say();
  RobotSays("m1", 2, State::kArrived);
  EXPECT_FALSE(HandedOver());
  EXPECT_EQ(LastOf("m2").state, State::kRefused);
  EXPECT_EQ(LastOf("m2").detail, "robot1 has not said where it stands");
  EXPECT_THAT(WaitsFor("m3"), HasSubstr("mission m2 did not arrive (refused)"));
}

class GoingHome : public GoingToPlaces {
 protected:
  void Answer(bool refused = false) {
    Hear(exchange::NowAnswer{.agent = AgentId("robot1"),
                             .client = AgentId("desk-p9"),
                             .number = commands_,
                             .refused = refused,
                             .detail = "so"});
  }
  static constexpr const char* kHome = "home-0000000000000001";
};

TEST_F(GoingHome, ARobotThatHasObeyedIsSentThereAndItsQueueIsHeldUntilItIsToldToResume) {
  Plan();
  RobotIsThere();
  Hear(For("m1"));
  RobotSays("m1", 1, State::kUnderWay);
  Hear(For("m2", "follow yard"));
  (void)Say();
  Tell(NowOrder::kHome, NowWhom::kAll, "");
  Answer();
  Answer();
  EXPECT_FALSE(HandedOver()) << "it has not ended what it did";
  RobotSays("m1", 2, State::kCancelled);
  const auto home = HandedOver();
  ASSERT_TRUE(home);
  EXPECT_EQ(home->id, kHome);
  EXPECT_EQ(home->orders, "goto home wait way") << "it is told the way from where it stands";
  EXPECT_THAT(goals_, testing::ElementsAre("home"));
  RobotSays(kHome, 1, State::kUnderWay);
  RobotSays(kHome, 2, State::kArrived);
  for (int restarts = 0; restarts < 2; ++restarts) {
    EXPECT_FALSE(HandedOver()) << "it is home, and stays there";
    EXPECT_THAT(WaitsFor("m2"), HasSubstr("sent home by desk on"));
    Restart();
    Plan();
    RobotIsThere();
  }
  Tell(NowOrder::kResume);
  EXPECT_EQ(HandedOver()->id, "m2");
}

TEST_F(GoingHome, OneThatDoesNotObeyIsSentNowhere) {
  Plan();
  RobotIsThere();
  Tell(NowOrder::kHome);
  Answer(true);
  EXPECT_FALSE(HandedOver());
  EXPECT_EQ(registry_->unanswered(), 0U);
}

TEST_F(GoingHome, OneWhosePlaceIsNotKnownSaysSoInsteadOfGoing) {
  Plan();
  way_ = Fail(ErrorCode::kNotFound, "robot1 has not said where it stands");
  RobotIsThere();
  Answer();
  Tell(NowOrder::kHome);
  Answer();  // which may come before the command does
  EXPECT_FALSE(HandedOver());
  const Report last = LastOf(kHome);
  EXPECT_EQ(last.state, State::kRefused);
  EXPECT_EQ(last.detail, "robot1 has not said where it stands");
}

TEST_F(GoingHome, OneThatIsThereHasArrived) {
  Plan();
  way_ = false;
  RobotIsThere();
  Tell(NowOrder::kHome);
  Answer();
  EXPECT_FALSE(HandedOver());
  EXPECT_EQ(StateOf(kHome), State::kArrived);
}

TEST_F(GoingHome, SentHomeWithAllItDoesNothingThatIsSentLaterUntilItIsToldToResume) {
  Plan();
  RobotIsThere();
  Tell(NowOrder::kHome, NowWhom::kAll, "");
  Answer();
  EXPECT_EQ(HandedOver()->id, kHome);
  RobotSays(kHome, 1, State::kArrived);
  for (int restarts = 0; restarts < 2; ++restarts) {
    (void)Say();
    Restart();
    Plan();
    RobotIsThere();
  }
  Hear(For("m1"));
  EXPECT_FALSE(HandedOver());
  EXPECT_THAT(WaitsFor("m1"), HasSubstr("sent home by desk on"));
  Tell(NowOrder::kCancel);
  EXPECT_EQ(StateOf("m1"), State::kCancelled);
  Hear(For("m2"));
  EXPECT_FALSE(HandedOver()) << "it was not told to resume";
  Tell(NowOrder::kResume, NowWhom::kAll, "");
  EXPECT_EQ(HandedOver()->id, "m2");
}

TEST_F(GoingHome, AQueueIsHeldThoughItsRobotIsOutOfReachOfThatCommand) {
  Hear(For("m1"));
  Tell(NowOrder::kHome, NowWhom::kAll, "");
  RobotIsThere();
  EXPECT_FALSE(HandedOver());
  EXPECT_THAT(WaitsFor("m1"), HasSubstr("sent home by desk on"));
  Tell(NowOrder::kResume);
  EXPECT_EQ(HandedOver()->id, "m1");
}

TEST_F(GoingHome, OneThatWasSentHomeAloneWithoutAQueueDoesWhatItIsSent) {
  Plan();
  RobotIsThere();
  Tell(NowOrder::kHome);
  Answer();
  EXPECT_EQ(HandedOver()->id, kHome);
  RobotSays(kHome, 1, State::kArrived);
  Hear(For("m1"));
  EXPECT_EQ(HandedOver()->id, "m1");
}

TEST_F(GoingHome, ItGoesBeforeItsQueueAlsoOverARestart) {
  Plan();
  Hear(For("m1", "follow yard"));
  RobotIsThere(1, exchange::AgentHold::kPaused);
  Tell(NowOrder::kHome);
  Answer();
  (void)Say();
  Restart();
  Plan();
  RobotIsThere();
  EXPECT_EQ(HandedOver()->id, kHome);
}

TEST_F(MissionRegistryTest, WhatIsCancelledIsNotHandedOverLater) {
  Hear(For("m1"));
  Tell(NowOrder::kPause, NowWhom::kAll, "");
  Tell(NowOrder::kCancel, NowWhom::kRobot, "robot2");
  Tell(NowOrder::kCancel, NowWhom::kOnRoute, "yard");
  EXPECT_EQ(registry_->unanswered(), 1U);
  Tell(NowOrder::kCancel, NowWhom::kOnRoute, "hall");
  const auto said = Said();
  ASSERT_TRUE(said);
  EXPECT_EQ(said->state, State::kCancelled);
  EXPECT_THAT(said->detail, HasSubstr("desk told it to cancel"));
  Hear(For("m2"));
  Tell(NowOrder::kCancel, NowWhom::kAll, "");
  EXPECT_EQ(registry_->unanswered(), 0U);
  RobotIsThere();
  EXPECT_FALSE(HandedOver());
}

TEST_F(MissionRegistryTest, KeepsWhoToldRobotsWhatAndWhatTheyAnswered) {
  exchange::NowCommand stop{.client = AgentId("desk-p9"), .number = 77};
  exchange::NowAnswer answer{
      .agent = AgentId("robot1"), .client = stop.client, .number = 77, .detail = "stands"};
  Hear(stop);
  Hear(stop);
  Hear(answer);
  stop.relayed = answer.relayed = true;
  Hear(stop);
  Hear(answer);
  Hear(exchange::MissionRequest{.client = AgentId("lab"), .request = 8, .commands = true});
  const auto said = Say();
  ASSERT_THAT(said, SizeIs(1));
  const auto& reply = std::get<exchange::MissionReply>(said[0]);
  ASSERT_THAT(reply.commands, SizeIs(1));
  EXPECT_EQ(reply.commands[0].command.client, AgentId("desk-p9"));
  ASSERT_THAT(reply.commands[0].answers, SizeIs(1));
  EXPECT_EQ(reply.commands[0].answers[0].detail, "stands");
}

TEST_F(MissionRegistryTest, TellsWhetherItHasHeardARobotAndElseWhichOthers) {
  const auto heard = [&](const std::string& robot) {
    Hear(exchange::MissionRequest{
        .client = AgentId("desk"), .request = 8, .query = {.agent = robot}});
    const auto said = Say();
    return said.size() == 1 ? std::get<exchange::MissionReply>(said[0]).robots
                            : std::vector<std::string>{"no reply"};
  };
  EXPECT_THAT(heard("robot1"), IsEmpty());
  RobotIsThere(1);
  EXPECT_THAT(heard("robot1"), ElementsAre("robot1"));
  EXPECT_THAT(heard("robto1"), ElementsAre("robot1"));
  EXPECT_THAT(heard(""), IsEmpty()) << "that is asked for each page of the history";
  Hear(exchange::AgentGone{AgentId("robot1"), 1});
  EXPECT_THAT(heard("robot1"), ElementsAre("robot1")) << "it is out of reach";
}

TEST_F(MissionRegistryTest, RefusesOrdersThatNobodyUnderstands) {
  Hear(For("m1", "dance"));
  const auto said = Said();
  ASSERT_TRUE(said);
  EXPECT_EQ(said->state, State::kRefused);
  EXPECT_THAT(said->detail, HasSubstr("'dance'"));
  EXPECT_EQ(registry_->unanswered(), 0U);
}

TEST_F(MissionRegistryTest, PutsOffWhatItCannotStoreAndKeepsItOnceItCan) {
  std::vector<Mission> missions;
  for (int i = 0; i < store::MissionStore::kMostUnansweredOfClient; ++i) {
    missions.push_back(For("m" + std::to_string(i)));
  }
  registry_->Take(missions, now_, unix_ms_);
  (void)Say();
  (void)registry_->TakeNotes();
  for (int i = 0; i < 3; ++i) {
    Hear(For("more"));
    const auto said = Said();
    ASSERT_TRUE(said);
    EXPECT_EQ(said->state, State::kPutOff) << "it is not refused for good";
    EXPECT_TRUE(said->relayed);
    EXPECT_THAT(said->detail, HasSubstr("missions of 'desk-p7' wait"));
  }
  EXPECT_THAT(registry_->TakeNotes(), SizeIs(1)) << "the log has it once";
  RobotSays("m0", 1, State::kAccepted);
  (void)Say();
  Hear(For("more"));
  EXPECT_EQ(Said()->state, State::kSent);
}

TEST_F(MissionRegistryTest, MissionsThatComeTogetherAreOneCommitAndSoIsTheirEnd) {
  const std::filesystem::path log = folder_ / "missions-wal";
  constexpr std::uintmax_t kPage = 4096;
  constexpr std::uintmax_t kMissions = 200;  // a commit writes three pages, each once
  std::vector<Mission> missions;
  for (std::uintmax_t i = 0; i < kMissions; ++i) missions.push_back(For("m" + std::to_string(i)));
  const auto before = std::filesystem::file_size(log);
  registry_->Take(missions, now_, unix_ms_);
  EXPECT_THAT(Say(), SizeIs(kMissions));
  const auto stored = std::filesystem::file_size(log);
  EXPECT_LT(stored - before, kMissions * kPage / 2);
  Tell(NowOrder::kCancel, NowWhom::kAll, "");
  EXPECT_THAT(Say(), SizeIs(kMissions)) << "cancelled, each";
  EXPECT_LT(std::filesystem::file_size(log) - stored, kMissions * kPage / 2);
  EXPECT_EQ(registry_->unanswered(), 0U);
}

TEST_F(MissionRegistryTest, RefusesOtherOrdersUnderTheSameName) {
  Hear(For("m1"));
  (void)Say();
  Hear(For("m1", "follow yard"));
  const auto said = Said();
  ASSERT_TRUE(said);
  EXPECT_EQ(said->state, State::kRefused);
  EXPECT_THAT(said->detail, HasSubstr("follow hall"));
  EXPECT_EQ(StateOf("m1"), State::kSent) << "the first is as it was";
}

TEST_F(MissionRegistryTest, LeavesToOtherServersWhatTheyPassOn) {
  Mission relayed = For("m1");
  relayed.relayed = true;
  Hear(relayed);
  Hear(Report{.agent = AgentId("robot1"), .mission = "m1", .change = 1, .relayed = true});
  EXPECT_THAT(Say(), IsEmpty());
}

TEST_F(MissionRegistryTest, TellsOfAnotherWayAgainAndAgainUntilTheMissionHasEnded) {
  const std::string first = "goto bay follow hall 0..2";
  const std::string other = "goto bay way 2 follow hall 0..1 follow yard 0..3 because it was so";
  EXPECT_FALSE(registry_->Amend(AgentId("robot1"), other)) << "of nothing";
  Hear(For("m1", first));
  RobotIsThere();
  EXPECT_THAT(registry_->AtWork(), IsEmpty()) << "it has not answered";
  RobotSays("m1", 1, State::kAccepted);
  (void)Say();
  ASSERT_THAT(registry_->AtWork(), SizeIs(1));
  EXPECT_EQ(registry_->CurrentOf(AgentId("robot1"))->last.state, State::kAccepted);
  Pass(seconds(5));
  EXPECT_FALSE(HandedOver()) << "it goes the way that it was sent";
  ASSERT_TRUE(registry_->Amend(AgentId("robot1"), other));
  for (int i = 0; i < 2; ++i) {
    const auto told = HandedOver();
    ASSERT_TRUE(told);
    EXPECT_EQ(told->orders, other);
    EXPECT_TRUE(told->relayed);
    EXPECT_FALSE(HandedOver()) << "at once again";
    Pass(seconds(3));
    Restart();
    RobotIsThere();
  }
  Hear(For("m1", first));
  const auto same = Said();
  ASSERT_TRUE(same);
  EXPECT_EQ(same->state, State::kAccepted) << "whoever sent it says it once more";
  Hear(For("m1", "goto dock follow hall 0..2"));
  const auto another = Said();
  ASSERT_TRUE(another);
  EXPECT_EQ(another->state, State::kRefused);
  RobotSays("m1", 2, State::kArrived);
  Pass(seconds(5));
  EXPECT_FALSE(HandedOver());
  EXPECT_EQ(registry_->CurrentOf(AgentId("robot1")), nullptr);
}

}  // namespace
}  // namespace trailcast::server
