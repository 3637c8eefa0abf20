#include "services/console/desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "services/program/presence.h"

namespace trailcast::console {
namespace {

using exchange::NowOrder;
using exchange::NowWhom;
using std::chrono::milliseconds;
using testing::HasSubstr;

class DeskTest : public testing::Test {
 protected:
  exchange::InProcessBus bus_;
  std::unique_ptr<exchange::RouteExchange> robot_ =
      bus_.Open(program::WithAgents(exchange::OnDutyTopics()));
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics()),
             Desk::Options{.answer_within = milliseconds(500), .reply_within = milliseconds(500)}};

  // The first of this kind that the robot hears.
  template <typename Message>
  Message Heard() {
    while (true) {
      for (exchange::Message& message : robot_->Take(milliseconds(100))) {
        if (auto* wanted = std::get_if<Message>(&message)) return *wanted;
      }
    }
  }
};

TEST_F(DeskTest, AnOrderBringsBackWhatTheRobotAnswers) {
  auto words = std::async(std::launch::async, [&] {
    return desk_.Tell(NowOrder::kPause, {NowWhom::kRobot, "robot1"}, "rain");
  });
  const auto command = Heard<exchange::NowCommand>();
  EXPECT_EQ(command.reason, "rain");
  ASSERT_TRUE(robot_->Publish(exchange::NowAnswer{.agent = AgentId("robot1"),
                                                  .client = command.client,
                                                  .number = command.number,
                                                  .detail = "paused"}));
  const auto told = words.get();
  ASSERT_TRUE(told) << told.error().message;
  EXPECT_TRUE(told->front().answered);
  EXPECT_EQ(told->front().detail, "paused");
}

TEST_F(DeskTest, WhoDoesNotAnswerIsNamed) {
  const auto told = desk_.Tell(NowOrder::kPause, {NowWhom::kRobot, "robot1"}, "");
  ASSERT_TRUE(told);
  EXPECT_FALSE(told->front().answered);
  const auto all = desk_.Tell(NowOrder::kStop, {NowWhom::kAll, ""}, "");
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().message, HasSubstr("no robot is heard"));
  const auto sent = desk_.Send({.agent = AgentId("robot1"), .id = "trip", .orders = "wait 1"});
  ASSERT_FALSE(sent);
  EXPECT_THAT(sent.error().message, HasSubstr("neither robot1 nor a route server"));
  EXPECT_FALSE(desk_.Missions({}));
}

TEST_F(DeskTest, AStopGoesOutWhileAllElseThatMayBeAskedWaits) {
  std::vector<std::future<bool>> others;
  for (std::size_t i = 0; i < 2 * Desk::kMostErrands; ++i) {
    others.push_back(
        std::async(std::launch::async, [&] { return desk_.Missions({}).has_value(); }));
  }
  auto stop = std::async(std::launch::async, [&] {
    return desk_.Tell(NowOrder::kStop, {NowWhom::kRobot, "robot1"}, "");
  });
  EXPECT_EQ(Heard<exchange::NowCommand>().order, NowOrder::kStop);
  ASSERT_TRUE(stop.get());
  for (auto& other : others) EXPECT_FALSE(other.get());
  const auto after = desk_.Tell(NowOrder::kPause, {NowWhom::kRobot, "robot1"}, "");
  EXPECT_TRUE(after) << "there is room again";
}

TEST_F(DeskTest, NewsComeWhenSomethingHasChanged) {
  const auto first = desk_.See(0, milliseconds(20'000));
  ASSERT_TRUE(first);
  EXPECT_FALSE(desk_.See(first->number, milliseconds(300)));
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  ASSERT_TRUE(robot_->Publish(status));
  const auto second = desk_.See(first->number, milliseconds(20'000));
  ASSERT_TRUE(second);
  EXPECT_THAT(second->state, HasSubstr("robot1"));
}

TEST_F(DeskTest, ClosedItLetsGoWhoWaits) {
  auto news = std::async(std::launch::async, [&] {
    const auto first = desk_.See(0, milliseconds(60'000));
    return desk_.See(first ? first->number : 0, milliseconds(60'000)) == nullptr;
  });
  desk_.Close();
  EXPECT_TRUE(news.get());
  EXPECT_FALSE(desk_.Tell(NowOrder::kStop, {NowWhom::kRobot, "robot1"}, ""));
}

}  // namespace
}  // namespace trailcast::console
