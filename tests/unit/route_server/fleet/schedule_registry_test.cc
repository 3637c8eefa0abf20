#include "route_server/fleet/schedule_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "route_server/fleet/mission_registry.h"
#include "tests/support/temp_dir.h"

namespace trailcast::server {
namespace {

using mission::Report;
using mission::State;
using schedule::Listed;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// 2026-11-30 is a Monday.
constexpr std::int64_t kMonday_7h_ms = 1'796'022'000'000;

// A server's two boards. Their clocks are stepped.
class ScheduleRegistryTest : public testing::Test {
 protected:
  void SetUp() override { Restart(); }
  void Restart() {
    registry_.reset();
    missions_.reset();
    auto store = store::MissionStore::Open(folder_ / "missions");
    ASSERT_TRUE(store) << store.error().message;
    auto missions = MissionRegistry::Open(AgentId("server"), std::move(*store));
    ASSERT_TRUE(missions) << missions.error().message;
    missions_ = std::move(*missions);
    ScheduleRegistry::Site site;
    site.take = [this](const auto& sent, auto now, auto now_unix_ms) {
      for (const mission::Mission& mission : sent) {
        taken_.push_back(mission.agent.value() + " " + mission.id);
      }
      if (takes_) missions_->Take(sent, now, now_unix_ms);
    };
    site.closed = [this](const std::string&) { return closed_; };
    auto registry = ScheduleRegistry::Open(AgentId("server"), missions_->store(), std::move(site));
    ASSERT_TRUE(registry) << registry.error().message;
    registry_ = std::move(*registry);
  }
  exchange::NetworkReply Tell(const std::string& words) {
    return registry_->Change(
        {.client = AgentId("desk-p7"), .request = ++requests_, .words = "schedule server " + words},
        unix_ms_);
  }
  void Add(const std::string& words) {
    const auto reply = Tell("add " + words);
    ASSERT_EQ(reply.error, "");
  }
  // Steps both clocks, and lets the registry look at them each second, or each minute of a long
  // time.
  void Pass(milliseconds time) {
    const milliseconds step = time > minutes(10) ? milliseconds(minutes(1)) : seconds(1);
    for (milliseconds passed{0}; passed < time; passed += step) {
      now_ += step;
      unix_ms_ += step.count();
      registry_->Tick(now_, unix_ms_);
    }
  }
  void ClockJumps(milliseconds by) { unix_ms_ += by.count(); }
  std::vector<std::string> Taken() { return std::exchange(taken_, {}); }
  void Hear(const std::string& robot, std::optional<std::uint8_t> battery_percent = {}) {
    exchange::AgentStatus status;
    status.agent = AgentId(robot);
    status.role = exchange::AgentRole::kFollower;
    status.mode = exchange::AgentMode::kWaiting;
    status.battery_percent = battery_percent;
    registry_->Hear(status);
  }
  void Ends(const std::string& robot, const std::string& id, State state) {
    missions_->Handle(
        Report{.agent = AgentId(robot), .mission = id, .change = ++changes_, .state = state}, now_,
        unix_ms_);
  }
  Listed Only() {
    const auto all =
        schedule::ParseLines(registry_->Answer({.client = AgentId("desk"), .request = 1}).lines);
    EXPECT_THAT(all, SizeIs(1));
    return all.empty() ? Listed{} : all.front();
  }
  std::vector<std::string> Outcomes() {
    std::vector<std::string> outcomes;
    for (const Listed::Sent& sent : Only().sent) {
      outcomes.push_back(sent.robot + " " + sent.outcome);
    }
    return outcomes;
  }

  test::TempDir folder_;
  std::chrono::steady_clock::time_point now_{};
  std::int64_t unix_ms_ = kMonday_7h_ms;
  std::string closed_;
  bool takes_ = true;
  std::vector<std::string> taken_;
  std::unique_ptr<MissionRegistry> missions_;
  std::unique_ptr<ScheduleRegistry> registry_;
  std::uint64_t requests_ = 0;
  std::uint32_t changes_ = 0;
};

TEST_F(ScheduleRegistryTest, SendsAMissionWhenItIsDueAndOnce) {
  Add("round to robot1 at 07:01 zone UTC valid 60 goes-on do follow hall");
  Pass(seconds(59));
  EXPECT_THAT(Taken(), IsEmpty());
  Pass(seconds(2));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0701Z"));
  const auto sent = missions_->store().Get(AgentId("robot1"), "round-20261130T0701Z");
  ASSERT_TRUE(sent && *sent);
  EXPECT_EQ((*sent)->mission.client, AgentId("desk"));
  EXPECT_EQ((*sent)->mission.orders, "follow hall");
  EXPECT_EQ((*sent)->mission.valid_for_s, 60U);
  EXPECT_TRUE((*sent)->mission.goes_on);
  Ends("robot1", "round-20261130T0701Z", State::kArrived);
  EXPECT_THAT(Outcomes(), ElementsAre("robot1 arrived"));
  EXPECT_EQ(Only().last_unix_ms, kMonday_7h_ms + 60'000);
  EXPECT_EQ(Only().next_unix_ms, kMonday_7h_ms + 60'000 + 86'400'000);
  Pass(hours(23));
  EXPECT_THAT(Taken(), IsEmpty());
  Pass(hours(1));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261201T0701Z"));
}

TEST_F(ScheduleRegistryTest, GoesOnAfterARestart) {
  Add("round to robot1 every 10 zone UTC do follow hall");
  Pass(minutes(10));
  EXPECT_THAT(Taken(), SizeIs(1));
  Ends("robot1", "round-20261130T0710Z", State::kArrived);
  Restart();
  Pass(minutes(5));
  EXPECT_THAT(Taken(), IsEmpty()) << "the last one was seen to";
  EXPECT_THAT(Outcomes(), ElementsAre("robot1 arrived"));
  Pass(minutes(5));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0720Z"));
}

// A server is killed between storing a mission and noting that it is sent.
TEST_F(ScheduleRegistryTest, SendsTheSameMissionAgainIfItMayNotHaveBeenSent) {
  Add("round to robot1 at 07:01 zone UTC do follow hall");
  auto before = missions_->store().Schedules();
  ASSERT_TRUE(before);
  Pass(minutes(1));
  EXPECT_THAT(Taken(), SizeIs(1));
  ASSERT_TRUE(missions_->store().Put(before->front()));
  Restart();
  Pass(seconds(30));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0701Z"));
  const auto all = missions_->store().Find({});
  ASSERT_TRUE(all);
  EXPECT_THAT(all->missions, SizeIs(1));
}

TEST_F(ScheduleRegistryTest, LeavesOutWhatWasMissed) {
  Add("round to robot1 every 10 zone UTC do follow hall");
  ClockJumps(hours(24) + minutes(5));
  Restart();
  Pass(minutes(1));
  EXPECT_THAT(Taken(), IsEmpty());
  EXPECT_THAT(Only().outcome, HasSubstr("missed"));
  Pass(minutes(4));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261201T0710Z"));
}

TEST_F(ScheduleRegistryTest, SendsOneForAllThatWereMissedIfToldSo) {
  Add("round to robot1 every 10 zone UTC missed once do follow hall");
  ClockJumps(hours(24) + minutes(5));
  Restart();
  Pass(minutes(1));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261201T0700Z"));
  Pass(minutes(3));
  EXPECT_THAT(Taken(), IsEmpty());
}

TEST_F(ScheduleRegistryTest, ClockThatJumpsByADaySendsNoDaysWorth) {
  Add("round to robot1 every 1 zone UTC missed once do follow hall");
  Pass(minutes(1));
  EXPECT_THAT(Taken(), SizeIs(1));
  Ends("robot1", "round-20261130T0701Z", State::kArrived);
  ClockJumps(hours(24));
  Pass(seconds(2));
  EXPECT_THAT(Taken(), SizeIs(1));
}

TEST_F(ScheduleRegistryTest, ClockThatWasAYearAheadDoesNotSilenceIt) {
  ClockJumps(hours(24 * 365));
  Add("round to robot1 every 1 zone UTC do follow hall");
  Pass(minutes(2));
  EXPECT_THAT(Taken(), SizeIs(1)) << "the first has not ended";
  Ends("robot1", "round-20271130T0701Z", State::kArrived);
  ClockJumps(-hours(24 * 365));
  Pass(minutes(2));
  EXPECT_THAT(Taken(), SizeIs(1)) << "the first has not ended";
}

TEST_F(ScheduleRegistryTest, SendsNoOtherWhileTheOneBeforeHasNotEnded) {
  Add("round to robot1 every 1 zone UTC do follow hall");
  Pass(minutes(5));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0701Z"));
  EXPECT_THAT(Outcomes(), ElementsAre(HasSubstr("round-20261130T0701Z, has not ended")));
  Ends("robot1", "round-20261130T0701Z", State::kFailed);
  Pass(minutes(1));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0706Z"));
}

TEST_F(ScheduleRegistryTest, SendsOnlyIfTheLastOneArrivedUntilItIsResumed) {
  Add("round to robot1 every 1 zone UTC if-arrived do follow hall");
  Pass(minutes(1));
  Ends("robot1", "round-20261130T0701Z", State::kArrived);
  Pass(minutes(1));
  Ends("robot1", "round-20261130T0702Z", State::kFailed);
  EXPECT_THAT(Taken(), SizeIs(2));
  Pass(minutes(2));
  EXPECT_THAT(Taken(), IsEmpty());
  EXPECT_THAT(Outcomes(), ElementsAre(HasSubstr("did not arrive (failed)")));
  EXPECT_EQ(Tell("resume round").error, "");
  Pass(minutes(1));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0705Z"));
}

TEST_F(ScheduleRegistryTest, SendsOnlyRobotsWithBatteryEnough) {
  Add("round to robot1,robot2,robot3 at 07:01 zone UTC battery 40 do follow hall");
  Hear("robot1", 40);
  Hear("robot2", 39);
  Pass(minutes(1) + seconds(5));
  EXPECT_THAT(Taken(), IsEmpty()) << "robot3 may be heard soon";
  Pass(seconds(10));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0701Z"));
  EXPECT_THAT(Outcomes(),
              ElementsAre("robot1 sent", HasSubstr("at 39 %, below 40 %"), HasSubstr("not heard")));
}

TEST_F(ScheduleRegistryTest, SendsNobodyWhileTheRouteIsClosed) {
  Add("round to robot1 every 1 zone UTC unless-closed do follow hall");
  closed_ = "hall 3..7 is closed";
  Pass(minutes(1));
  EXPECT_THAT(Taken(), IsEmpty());
  EXPECT_EQ(Only().outcome, "hall 3..7 is closed");
  closed_.clear();
  Pass(minutes(1));
  EXPECT_THAT(Taken(), SizeIs(1));
  EXPECT_EQ(Only().outcome, "");
}

TEST_F(ScheduleRegistryTest, SendsAllOfAPatternThatAreHeard) {
  Add("round to cart-* at 07:01 zone UTC do follow hall");
  Hear("cart-1");
  Hear("cart-2");
  Hear("robot1");
  registry_->Hear(exchange::AgentGone{.agent = AgentId("cart-2"), .instance = 0});
  Hear("cart-3");
  Pass(minutes(1));
  EXPECT_THAT(Taken(), ElementsAre("cart-1 round-20261130T0701Z", "cart-3 round-20261130T0701Z"));
}

TEST_F(ScheduleRegistryTest, ServerThatHasJustStartedWaitsForTheRobotsOfAPattern) {
  Add("round to cart-* at 07:01 zone UTC do follow hall");
  ClockJumps(seconds(59));
  Restart();
  Hear("cart-1");
  Pass(seconds(5));
  EXPECT_THAT(Taken(), IsEmpty());
  Hear("cart-2");
  Pass(seconds(10));
  EXPECT_THAT(Taken(), SizeIs(2));
}

TEST_F(ScheduleRegistryTest, SaysThatThereWasNobodyToSendTo) {
  Add("round to cart-* at 07:01 zone UTC do follow hall");
  Pass(minutes(2));
  EXPECT_THAT(Taken(), IsEmpty());
  EXPECT_THAT(Only().outcome, HasSubstr("nobody to send to: no robot 'cart-*' is heard"));
}

TEST_F(ScheduleRegistryTest, SendsAgainWhatCouldNotBeStored) {
  Add("round to robot1 at 07:01 zone UTC do follow hall");
  takes_ = false;
  Pass(minutes(1) + seconds(5));
  EXPECT_THAT(Taken(), SizeIs(testing::Ge(3U)));
  takes_ = true;
  Pass(seconds(5));
  EXPECT_THAT(Taken(), SizeIs(1));
  EXPECT_THAT(Outcomes(), ElementsAre("robot1 sent"));
}

TEST_F(ScheduleRegistryTest, PausedSendsNobodyAndMissesNothing) {
  Add("round to robot1 every 10 zone UTC missed once do follow hall");
  EXPECT_EQ(Tell("pause round").error, "");
  EXPECT_EQ(Only().paused_by, "desk");
  EXPECT_EQ(Only().next_unix_ms, std::nullopt);
  Pass(minutes(25));
  Restart();
  Pass(minutes(1));
  EXPECT_THAT(Taken(), IsEmpty());
  EXPECT_EQ(Tell("resume round").error, "");
  Pass(minutes(1));
  EXPECT_THAT(Taken(), IsEmpty());
  Pass(minutes(4));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0730Z"));
}

TEST_F(ScheduleRegistryTest, ChangedSendsAtItsNewTimesAndMissesNothing) {
  Add("round to robot1 at 07:01 zone UTC do follow hall");
  Pass(minutes(2));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0701Z"));
  Ends("robot1", "round-20261130T0701Z", State::kArrived);
  EXPECT_EQ(Tell("change round to robot1 at 06:50,07:04 zone UTC missed once do follow yard").error,
            "");
  EXPECT_EQ(Only().schedule.orders, "follow yard");
  EXPECT_THAT(Outcomes(), ElementsAre("robot1 arrived")) << "what it has sent stays known";
  Restart();
  Pass(minutes(1));
  EXPECT_THAT(Taken(), IsEmpty()) << "06:50 has passed, and was none of its times";
  Pass(minutes(1));
  EXPECT_THAT(Taken(), ElementsAre("robot1 round-20261130T0704Z"));
  ASSERT_EQ(Tell("pause round").error, "");
  EXPECT_EQ(Tell("change round to robot2 at 08:00 zone UTC do follow hall").error, "");
  EXPECT_EQ(Only().paused_by, "desk");
  EXPECT_THAT(Tell("change round to robot2 once 2020-01-01 08:00 zone UTC do follow hall").error,
              HasSubstr("is past"));
  EXPECT_THAT(Tell("change other to robot2 at 08:00 zone UTC do follow hall").error,
              HasSubstr("no schedule is called 'other'"));
}

TEST_F(ScheduleRegistryTest, RemovedIsGoneAfterARestartToo) {
  Add("round to robot1 every 1 zone UTC do follow hall");
  EXPECT_EQ(Tell("remove round").error, "");
  EXPECT_THAT(Tell("remove round").error, HasSubstr("no schedule is called 'round'"));
  Restart();
  Pass(minutes(2));
  EXPECT_THAT(Taken(), IsEmpty());
  EXPECT_EQ(registry_->size(), 0U);
}

TEST_F(ScheduleRegistryTest, RepeatedChangeIsMadeOnce) {
  const exchange::NetworkEdit edit{
      .client = AgentId("desk"), .request = 7, .words = "schedule server remove round"};
  Add("round to robot1 every 1 zone UTC do follow hall");
  EXPECT_EQ(registry_->Change(edit, unix_ms_).error, "");
  EXPECT_EQ(registry_->Change(edit, unix_ms_).error, "");
}

TEST_F(ScheduleRegistryTest, RefusesAnotherOfTheSameNameOneThatIsPastAndTooMany) {
  Add("round to robot1 every 1 zone UTC do follow hall");
  Add("round to robot1 every 1 zone UTC do follow hall");
  EXPECT_THAT(Tell("add round to robot1 every 2 zone UTC do follow hall").error,
              HasSubstr("there is a schedule round already, every 1 zone UTC"));
  EXPECT_THAT(Tell("add past to robot1 once 2026-11-30 07:00 zone UTC do follow hall").error,
              HasSubstr("is past, it is Mon 2026-11-30 07:00 UTC now"));
  for (std::size_t i = 1; i < ScheduleRegistry::kMostSchedules; ++i) {
    Add("s" + std::to_string(i) + " to robot1 every 1 zone UTC do follow hall");
  }
  EXPECT_THAT(Tell("add more to robot1 every 1 zone UTC do follow hall").error,
              HasSubstr("200 schedules already"));
}

TEST_F(ScheduleRegistryTest, OnceIsSentOnceAndListedUntilItIsRemoved) {
  Add("audit to robot1 once 2026-11-30 08:30 zone Europe/Berlin do goto office@8");
  Pass(minutes(31));
  EXPECT_THAT(Taken(), ElementsAre("robot1 audit-20261130T0730Z"));
  EXPECT_EQ(Only().next_unix_ms, std::nullopt);
  EXPECT_THAT(Outcomes(), ElementsAre("robot1 sent"));
}

}  // namespace
}  // namespace trailcast::server
