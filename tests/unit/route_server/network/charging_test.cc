#include "route_server/network/charging.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::server {
namespace {

using exchange::NowOrder;
using exchange::NowWhom;
using mission::State;
using std::chrono::seconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// hall of 20 m has a dock at 12 m and a home at 2 m. Time passes in steps of a second.
class ChargingTest : public testing::Test {
 protected:
  void SetUp() override {
    route::RouteInfo hall =
        test::InfoOf(test::KeyNumber(1, 1), test::PiecesOf(test::KeyNumber(1, 1), 2),
                     route::RouteState::kComplete);
    hall.name = "hall";
    hall.length_m = 20.0;
    hall.standing = route::Standing::kActive;
    ASSERT_TRUE(routes_.PutRoute(hall));
    Restart();
    Edit("back hall");
    Edit("wide hall");
    Edit("name parking hall@2 home");
    Edit("name dock1 hall@12 dock");
    Edit("charge below 20 until 90");
  }
  void Restart() {
    charging_.reset();
    network_.reset();
    missions_.reset();
    const AgentId server("server");
    auto junctions = store::NetworkStore::Open(folder_ / "joints");
    auto missions = store::MissionStore::Open(folder_ / "missions");
    ASSERT_TRUE(junctions && missions);
    network_ = NetworkRegistry::Open(server, std::move(*junctions), routes_).value();
    missions_ = MissionRegistry::Open(server, std::move(*missions)).value();
    charging_.emplace(server, *missions_, *network_);
    missions_->WaitBy([this](const auto& first) { return charging_->WhyNot(first); });
    missions_->PlanBy([this](const AgentId& agent, const std::string& goal) -> Result<bool> {
      const auto way = network_->WayOn(network_->StandOf(agent)->place, goal);
      if (!way) return tl::unexpected(way.error());
      return !way->empty();
    });
  }
  std::vector<std::string> Edit(const std::string& words) {
    const auto reply = network_->Change({AgentId("desk"), ++requests_, words}, unix_ms_);
    EXPECT_EQ(reply.error, "") << words;
    return reply.lines;
  }
  // Every message goes to all three, as in a server.
  void Hear(const exchange::Message& message) {
    missions_->Handle(message, now_, unix_ms_);
    charging_->Hear(message);
    if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) network_->Hear(*status);
  }
  void IsAt(const std::string& robot, std::optional<double> along_m,
            std::optional<std::uint8_t> battery_percent) {
    exchange::AgentStatus status;
    status.agent = AgentId(robot);
    status.instance = 1;
    status.role = exchange::AgentRole::kFollower;
    status.mode = exchange::AgentMode::kWaiting;
    status.on_duty = true;
    status.battery_percent = battery_percent;
    if (along_m) status.place = exchange::PlaceOnRoute{test::KeyNumber(1, 1), *along_m};
    Hear(status);
  }
  void Send(const std::string& robot, const std::string& id, const std::string& orders) {
    Hear(mission::Mission{.agent = AgentId(robot),
                          .id = id,
                          .client = AgentId("desk"),
                          .orders = orders,
                          .valid_for_s = 600});
  }
  void Says(const std::string& robot, const std::string& id, State state,
            mission::WaitsFor waits_for = mission::WaitsFor::kNothing) {
    Hear(mission::Report{.agent = AgentId(robot),
                         .mission = id,
                         .change = ++change_,
                         .state = state,
                         .waits_for = waits_for});
  }
  void Tell(NowOrder order, const std::string& robot) {
    Hear(exchange::NowCommand{.client = AgentId("desk"),
                              .number = ++requests_,
                              .order = order,
                              .whom = NowWhom::kRobot,
                              .name = robot});
  }
  // Returns what robots are sent after a second, as "robot1 ORDERS".
  std::vector<std::string> Pass() {
    now_ += seconds(1);
    unix_ms_ += 1000;
    charging_->Tick(now_, unix_ms_);
    std::vector<std::string> sent;
    for (const exchange::Message& message : missions_->Tick(now_, unix_ms_)) {
      const auto* mission = std::get_if<mission::Mission>(&message);
      if (mission == nullptr) continue;
      sent.push_back(mission->agent.value() + " " + mission->orders);
      handed_[mission->agent.value()] = mission->id;
    }
    EXPECT_THAT(charging_->TakeTroubles(), IsEmpty());
    return sent;
  }
  // Does what the robot was handed last.
  void Does(const std::string& robot, double along_m, std::uint8_t battery_percent) {
    Says(robot, handed_.at(robot), State::kUnderWay);
    IsAt(robot, along_m, battery_percent);
    Says(robot, handed_.at(robot), State::kArrived);
  }
  std::vector<std::string> Answered(const std::string& words) {
    return network_->Answer({AgentId("desk"), ++requests_, words}).lines;
  }
  std::vector<std::string> Listed() {
    std::vector<std::string> lines;
    for (const std::string& line : Answered("")) {
      if (line.starts_with("charging ") || line.starts_with("name dock")) lines.push_back(line);
    }
    return lines;
  }
  std::string WaitsFor(const std::string& robot) { return missions_->WhyNotNow(AgentId(robot)); }

  test::TempDir folder_;
  test::MemoryStore routes_;
  std::unique_ptr<NetworkRegistry> network_;
  std::unique_ptr<MissionRegistry> missions_;
  std::optional<Charging> charging_;
  std::chrono::steady_clock::time_point now_{seconds(100)};
  std::int64_t unix_ms_ = 1'700'000'000'000;
  std::uint64_t requests_ = 100;
  std::uint32_t change_ = 0;
  std::map<std::string, std::string> handed_;
};

TEST_F(ChargingTest, ARobotChargesAfterItsMissionAndBeforeItsQueue) {
  IsAt("robot1", 1.0, 30);
  Send("robot1", "m1", "follow hall");
  EXPECT_THAT(Pass(), ElementsAre("robot1 follow hall"));
  Says("robot1", "m1", State::kUnderWay);
  Send("robot1", "m2", "follow hall 3..4");
  IsAt("robot1", 5.0, 19);
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_THAT(Listed(), ElementsAre("name dock1 hall@12 dock",
                                    AllOf(HasSubstr("charging robot1 is to charge, its battery is "
                                                    "at 19 %; waits: it does mission m1"))));
  IsAt("robot1", 6.0, 18);
  Says("robot1", "m1", State::kArrived);
  EXPECT_THAT(Pass(), ElementsAre("robot1 goto dock1 wait way"));
  EXPECT_THAT(Listed(), Contains("name dock1 hall@12 dock, taken by robot1"));
  Says("robot1", handed_["robot1"], State::kUnderWay);
  (void)Pass();
  EXPECT_THAT(Listed(),
              Contains("charging robot1 goes to dock1 to charge, its battery is at 18 %"));
  Does("robot1", 12.7, 17);  // a little beside it
  const std::string charges =
      "charges at dock1: its battery is at 17 %, and it goes on at 90 %, or when it is told to "
      "resume";
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_THAT(Listed(), ElementsAre("name dock1 hall@12 dock, taken by robot1",
                                    "charging robot1 " + charges));
  EXPECT_THAT(Answered("charging"), ElementsAre("charging robot1 " + charges)) << "those alone";
  EXPECT_EQ(WaitsFor("robot1"), "it " + charges) << "what its queue waits for";
  IsAt("robot1", {}, 89);
  EXPECT_THAT(Pass(), IsEmpty());
  IsAt("robot1", {}, 90);
  EXPECT_THAT(Pass(), ElementsAre("robot1 follow hall 3..4"));
  Says("robot1", "m2", State::kUnderWay);
  IsAt("robot1", 3.0, 88);
  (void)Pass();
  EXPECT_THAT(Listed(), ElementsAre("name dock1 hall@12 dock")) << "it has left";
}

TEST_F(ChargingTest, OneThatTellsNoBatteryOrHasEnoughIsNeverSentNorIsAnyUnlessThatIsWanted) {
  IsAt("robot1", 1.0, {});
  IsAt("robot2", 1.0, 20);
  EXPECT_THAT(Pass(), IsEmpty());
  Edit("charge never");
  IsAt("robot2", 1.0, 3);
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_EQ(missions_->unanswered(), 0U);
}

TEST_F(ChargingTest, OneRobotAtATimeHasADockAndTheOtherSaysThatItWaitsAlsoOverARestart) {
  IsAt("robot1", 1.0, 10);
  IsAt("robot2", 3.0, 10);
  EXPECT_THAT(Pass(), ElementsAre("robot1 goto dock1 wait way"));
  EXPECT_EQ(WaitsFor("robot2"), "no dock is free: dock1 is taken by robot1");
  EXPECT_THAT(Listed(), Contains("charging robot2 is to charge, its battery is at 10 %; waits: no "
                                 "dock is free: dock1 is taken by robot1"));
  Does("robot1", 12.0, 10);
  (void)Pass();
  Restart();
  IsAt("robot2", 3.0, 9);
  EXPECT_THAT(Pass(), IsEmpty()) << "robot1 is silent, and stands there";
  EXPECT_EQ(WaitsFor("robot2"), "no dock is free: dock1 is taken by robot1");
  IsAt("robot1", {}, 12);
  (void)Pass();
  EXPECT_THAT(Listed(), Contains(HasSubstr("charging robot1 charges at dock1")));
  EXPECT_THAT(Edit("vacate hall"), ElementsAre("robot1 no longer has dock1"));
  EXPECT_THAT(Pass(), ElementsAre("robot2 goto dock1 wait way"));
}

TEST_F(ChargingTest, OneThatIsFullAndHasNothingToDoLeavesItsDockToAnother) {
  IsAt("robot1", 10.0, 10);
  EXPECT_THAT(Pass(), ElementsAre("robot1 goto dock1 wait way"));
  Does("robot1", 12.0, 10);
  (void)Pass();
  IsAt("robot1", {}, 95);
  EXPECT_THAT(Pass(), IsEmpty()) << "nobody waits";
  IsAt("robot2", 3.0, 10);
  EXPECT_THAT(Pass(), ElementsAre("robot1 goto home wait way"));
  Does("robot1", 2.0, 94);
  EXPECT_THAT(Pass(), ElementsAre("robot2 goto dock1 wait way"));
}

TEST_F(ChargingTest, OneThatDoesNotKnowWhereItIsSaysSoInsteadOfGoing) {
  IsAt("robot1", {}, 10);
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_EQ(WaitsFor("robot1"), "it does not know where it is");
  IsAt("robot1", 3.0, 10);
  EXPECT_THAT(Pass(), ElementsAre("robot1 goto dock1 wait way"));
}

TEST_F(ChargingTest, OneThatIsLostGoesNowhereAndWaitsForAPersonThen) {
  IsAt("robot1", 1.0, 30);
  Send("robot1", "m1", "follow hall");
  (void)Pass();
  IsAt("robot1", 3.0, 10);
  Says("robot1", "m1", State::kFailed, mission::WaitsFor::kPlace);
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_EQ(WaitsFor("robot1"),
            "mission m1 did not arrive (failed): resume the robot to go on, or cancel");
  Tell(NowOrder::kResume, "robot1");
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_EQ(WaitsFor("robot1"), "it does not know where it is");
}

TEST_F(ChargingTest, ACancelledMissionToADockIsNotSentAgainUntilItsRobotIsToldToResume) {
  IsAt("robot1", 1.0, 10);
  IsAt("robot2", 3.0, 10);
  (void)Pass();
  Tell(NowOrder::kCancel, "robot2");
  Does("robot1", 12.0, 95);
  EXPECT_THAT(Pass(), Not(Contains(HasSubstr("robot2"))));
  EXPECT_THAT(WaitsFor("robot2"), HasSubstr("did not arrive (cancelled)"));
  IsAt("robot1", 2.0, 95);
  Tell(NowOrder::kResume, "robot2");
  EXPECT_THAT(Pass(), Contains("robot2 goto dock1 wait way"));
}

TEST_F(ChargingTest, AnOperatorMayHaveItGoOnBeforeItIsFull) {
  IsAt("robot1", 10.0, 10);
  (void)Pass();
  Does("robot1", 12.0, 10);
  Send("robot1", "m1", "follow hall");
  EXPECT_THAT(Pass(), IsEmpty());
  IsAt("robot1", {}, 40);
  Tell(NowOrder::kResume, "robot1");
  EXPECT_THAT(Pass(), ElementsAre("robot1 follow hall"));
}

TEST_F(ChargingTest, AMissionToADockThatAnotherRobotHasWaits) {
  IsAt("robot1", 12.0, 50);
  IsAt("robot2", 3.0, 50);
  (void)Pass();
  for (const std::string goal : {"dock1", "hall@12.2"}) {
    Send("robot2", "to-" + goal.substr(0, 4), "goto " + goal + " follow hall 3..12.2");
    EXPECT_THAT(Pass(), IsEmpty());
    EXPECT_EQ(WaitsFor("robot2"), "dock1 is taken by robot1");
    Tell(NowOrder::kCancel, "robot2");
  }
  Send("robot2", "m9", "goto dock1 follow hall 3..12");
  IsAt("robot1", 15.0, 50);
  (void)Pass();
  EXPECT_THAT(Pass(), ElementsAre("robot2 goto dock1 follow hall 3..12"));
}

TEST_F(ChargingTest, TwoThatAreSentToADockAtOnceGoThereOneByOne) {
  IsAt("robot1", 1.0, 50);
  IsAt("robot2", 3.0, 50);
  (void)Pass();
  Send("robot1", "m1", "goto dock1 follow hall 1..12");
  Send("robot2", "m2", "goto dock1 follow hall 3..12");
  EXPECT_THAT(Pass(), ElementsAre("robot1 goto dock1 follow hall 1..12"));
}

TEST_F(ChargingTest, OneThatWaitsForADockGoesOnIfThatIsNoLongerWantedOrNeeded) {
  IsAt("robot1", 12.0, 50);
  IsAt("robot2", 3.0, 10);
  (void)Pass();
  Send("robot2", "m1", "follow hall 3..4");
  EXPECT_THAT(Pass(), IsEmpty());
  IsAt("robot2", 3.0, 92);
  EXPECT_THAT(Pass(), ElementsAre("robot2 follow hall 3..4")) << "somebody has charged it";
  Says("robot2", "m1", State::kUnderWay);
  IsAt("robot2", 3.5, 10);
  (void)Pass();
  EXPECT_EQ(missions_->unanswered(), 1U);
  Edit("charge never");
  (void)Pass();
  EXPECT_EQ(missions_->unanswered(), 0U);
  EXPECT_THAT(Listed(), ElementsAre("name dock1 hall@12 dock, taken by robot1"));
}

}  // namespace
}  // namespace trailcast::server
