// Missions for groups, and for several robots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "route_server/fleet/mission_registry.h"
#include "tests/support/temp_dir.h"

namespace trailcast::server {
namespace {

using exchange::NowOrder;
using mission::Mission;
using mission::Report;
using mission::State;
using std::chrono::seconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class MissionGroupsTest : public testing::Test {
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
  void Hear(const exchange::Message& message) { registry_->Handle(message, now_, unix_ms_); }
  void Send(const std::string& to, const std::string& id, const std::string& orders = "follow hall",
            std::uint32_t valid_for_s = 60) {
    Hear(Mission{.agent = AgentId(to),
                 .id = id,
                 .client = AgentId("desk-p7"),
                 .orders = orders,
                 .valid_for_s = valid_for_s});
  }
  void IsThere(const std::string& robot, exchange::AgentHold hold = exchange::AgentHold::kNone,
               const std::string& detail = "held by desk") {
    exchange::AgentStatus status;
    status.agent = AgentId(robot);
    status.instance = 1;
    status.role = exchange::AgentRole::kFollower;
    status.mode = exchange::AgentMode::kWaiting;
    status.hold = hold;
    status.detail = detail;
    Hear(status);
  }
  void Says(const std::string& robot, const std::string& id, State state) {
    Hear(Report{.agent = AgentId(robot), .mission = id, .change = ++change_, .state = state});
  }
  void Tell(NowOrder order, const std::string& name) {
    Hear(exchange::NowCommand{.client = AgentId("desk-p9"),
                              .number = ++commands_,
                              .order = order,
                              .whom = exchange::NowWhom::kRobot,
                              .name = name});
  }
  // Returns what robots are handed after a second, as "cart-1 m1", and keeps what is said.
  std::vector<std::string> Pass() {
    now_ += seconds(1);
    unix_ms_ += 1000;
    std::vector<std::string> handed;
    for (const exchange::Message& message : registry_->Tick(now_, unix_ms_)) {
      if (const auto* mission = std::get_if<Mission>(&message)) {
        handed.push_back(mission->agent.value() + " " + mission->id);
      } else if (const auto* report = std::get_if<Report>(&message)) {
        said_[report->agent.value()] =
            std::string(mission::ToString(report->state)) + " " + report->detail;
      } else if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) {
        answered_ = (answer->refused ? "refused: " : "") + answer->detail;
      }
    }
    return handed;
  }

  test::TempDir folder_;
  std::chrono::steady_clock::time_point now_{};
  std::int64_t unix_ms_ = 1'700'000'000'000;
  std::unique_ptr<MissionRegistry> registry_;
  std::map<std::string, std::string> said_;
  std::string answered_;
  std::uint64_t commands_ = 0;
  std::uint32_t change_ = 0;
};

TEST_F(MissionGroupsTest, AFreeRobotOfTheGroupTakesItOnceHoweverOftenItIsSent) {
  IsThere("cart-1");
  IsThere("cart-2");
  IsThere("lift");
  Send("cart-1", "m1");
  EXPECT_THAT(Pass(), ElementsAre("cart-1 m1"));
  Says("cart-1", "m1", State::kUnderWay);
  Send("@cart", "m2");
  EXPECT_THAT(Pass(), ElementsAre("cart-2 m2"));
  Says("cart-2", "m2", State::kUnderWay);
  for (int restarts = 0; restarts < 2; ++restarts) {
    Send("@cart", "m2");
    EXPECT_THAT(Pass(), IsEmpty());
    EXPECT_THAT(said_["cart-2"], HasSubstr("under way")) << "its sender is told who has it";
    EXPECT_EQ(registry_->unanswered(), 0U);
    Restart();
    IsThere("cart-1");
    IsThere("cart-2");
  }
}

TEST_F(MissionGroupsTest, AHeldRobotIsNotFreeBeforeItHasSaidWhyItIsHeld) {
  IsThere("cart-1", exchange::AgentHold::kPaused, "");
  Send("@cart", "m1");
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_EQ(said_["@cart"], "sent waits: no robot of @cart is free; cart-1: it is paused");
  IsThere("cart-1", exchange::AgentHold::kPaused);
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_EQ(said_["@cart"], "sent waits: no robot of @cart is free; cart-1: held by desk");
  IsThere("cart-1");
  EXPECT_THAT(Pass(), ElementsAre("cart-1 m1"));
}

TEST_F(MissionGroupsTest, ItWaitsForTheFirstThatIsFreeAndSaysWhatTheyDo) {
  Send("@cart", "m1");
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_EQ(said_["@cart"], "sent waits: no robot of @cart is heard");
  IsThere("cart-1");
  IsThere("cart-2", exchange::AgentHold::kPaused);
  Send("cart-1", "m0");
  (void)Pass();
  Says("cart-1", "m0", State::kUnderWay);
  Send("@cart", "m1");
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_EQ(said_["@cart"],
            "sent waits: no robot of @cart is free; cart-1: it does mission m0: follow hall; "
            "cart-2: held by desk");
  Restart();
  IsThere("cart-1");
  IsThere("cart-2");
  EXPECT_THAT(Pass(), ElementsAre("cart-2 m1"));
}

TEST_F(MissionGroupsTest, SeveralForAGroupGoToOneRobotEach) {
  IsThere("cart-1");
  IsThere("cart-2");
  for (const char* id : {"m1", "m2", "m3"}) Send("@cart", id);
  EXPECT_THAT(Pass(), UnorderedElementsAre("cart-1 m1", "cart-2 m2"));
  Says("cart-1", "m1", State::kUnderWay);
  Says("cart-2", "m2", State::kUnderWay);
  EXPECT_THAT(Pass(), IsEmpty());
  Says("cart-2", "m2", State::kArrived);
  EXPECT_THAT(Pass(), ElementsAre("cart-2 m3"));
}

TEST_F(MissionGroupsTest, ToAPlaceItIsGivenToARobotThatHasAPath) {
  registry_->PlanBy([](const AgentId& agent, const std::string&) -> Result<bool> {
    if (agent.value() == "cart-2") return true;
    return Fail(ErrorCode::kNotFound, "no way leads there");
  });
  IsThere("cart-1");
  Send("@cart", "m1", "goto bay wait way");
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_THAT(said_["@cart"], HasSubstr("cart-1: no way leads there"));
  IsThere("cart-2");
  EXPECT_THAT(Pass(), ElementsAre("cart-2 m1"));
}

TEST_F(MissionGroupsTest, WhatWaitsForAGroupIsCancelledAndExpiresIfNoRobotOfItIsThere) {
  Send("@cart", "m1");
  (void)Pass();
  Tell(NowOrder::kCancel, "@cart");
  (void)Pass();
  EXPECT_EQ(answered_, "what waits for the group is told so");
  EXPECT_THAT(said_["@cart"], HasSubstr("cancelled desk told it to cancel"));
  Tell(NowOrder::kCancel, "@cart");
  (void)Pass();
  EXPECT_EQ(answered_, "refused: no mission waits for the group");
  Tell(NowOrder::kPause, "@cart");
  (void)Pass();
  EXPECT_THAT(answered_, HasSubstr("refused: a group is told to cancel, stop or resume alone"));
  Send("@cart", "m2", "follow hall", 3);
  for (int i = 0; i < 5; ++i) (void)Pass();
  EXPECT_THAT(said_["@cart"], HasSubstr("expired"));
}

TEST_F(MissionGroupsTest, AMissionForSeveralIsKeptForAllOrForNone) {
  IsThere("cart-1");
  IsThere("cart-2");
  IsThere("lift");
  Send("lift,@cart", "m1");
  EXPECT_THAT(Pass(), UnorderedElementsAre("lift m1", "cart-1 m1"));
  Says("lift", "m1", State::kUnderWay);
  Says("cart-1", "m1", State::kUnderWay);
  said_.clear();
  Send("lift,@cart", "m1");
  EXPECT_THAT(Pass(), IsEmpty());
  EXPECT_THAT(said_["lift"], HasSubstr("under way"));
  EXPECT_THAT(said_["cart-1"], HasSubstr("under way")) << "it is for no other robot of its group";
  Send("lift,cart-1", "m2", "follow");
  (void)Pass();
  EXPECT_THAT(said_["lift,cart-1"], HasSubstr("refused"));
  EXPECT_THAT(registry_->store().Find({.id = "m2"})->missions, IsEmpty());
}

TEST_F(MissionGroupsTest, WithoutRoomForAllNoneIsKept) {
  for (std::int64_t i = 0; i + 1 < store::MissionStore::kMostUnansweredOfClient; ++i) {
    ASSERT_TRUE(registry_->store().AddAll(std::vector{Mission{.agent = AgentId("cart-9"),
                                                              .id = "m" + std::to_string(i),
                                                              .client = AgentId("desk-p7"),
                                                              .orders = "follow hall"}},
                                          unix_ms_));
  }
  Send("lift,cart-1", "many");
  (void)Pass();
  EXPECT_THAT(said_["lift,cart-1"], AllOf(HasSubstr("put off"), HasSubstr("cancel some")));
  EXPECT_THAT(registry_->store().Find({.id = "many"})->missions, IsEmpty());
}

}  // namespace
}  // namespace trailcast::server
