#include "services/fleet/now_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "services/program/presence.h"

namespace trailcast::fleet {
namespace {

using exchange::AgentMode;
using exchange::NowOrder;
using exchange::NowWhom;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

// Robots on a bus, of which some answer, perhaps only once they have been told for a while.
class NowClientTest : public testing::Test {
 protected:
  void TearDown() override {
    ending_ = true;
    for (std::thread& robot : robots_) robot.join();
  }
  void Robot(const std::string& name, const std::string& route, bool answers, bool refuses = false,
             int deaf_to = 0) {
    robots_.emplace_back([this, name, route, answers, refuses, deaf_to,
                          exchange = std::shared_ptr<exchange::RouteExchange>(
                              bus_.Open(program::WithAgents(exchange::FollowerTopics())))] {
      exchange::AgentStatus status;
      status.agent = AgentId(name);
      status.role = exchange::AgentRole::kFollower;
      status.mode = AgentMode::kReplaying;
      status.route = route;
      (void)exchange->Publish(status);
      while (!ending_) {
        for (const exchange::Message& message : exchange->Take(milliseconds(10))) {
          const auto* command = std::get_if<exchange::NowCommand>(&message);
          if (command == nullptr || !answers || ++heard_ <= deaf_to) continue;
          (void)exchange->Publish(exchange::NowAnswer{.agent = AgentId(name),
                                                      .client = command->client,
                                                      .number = command->number,
                                                      .refused = refuses,
                                                      .detail = "says " + name});
        }
      }
    });
  }
  Result<std::vector<RobotsWord>> Tell(const std::vector<NowTarget>& targets,
                                       milliseconds timeout = 2 * test::kLongEnough) {
    const auto desk = bus_.Open(exchange::DispatcherTopics());
    return TellRobots(*desk, AgentId("desk"), NowOrder::kPause, targets, "why", timeout);
  }

  exchange::InProcessBus bus_;
  std::atomic<bool> ending_{false};
  std::atomic<int> heard_{0};
  std::vector<std::thread> robots_;
};

TEST_F(NowClientTest, ReturnsAsSoonAsTheRobotThatIsNamedHasAnswered) {
  Robot("robot1", "hall", true);
  const auto began = std::chrono::steady_clock::now();
  const auto words = Tell({{NowWhom::kRobot, "robot1"}});
  ASSERT_TRUE(words) << words.error().message;
  EXPECT_EQ(WordsText(*words), "robot1: says robot1\n");
  EXPECT_LT(std::chrono::steady_clock::now() - began, test::kLongEnough);
}

TEST_F(NowClientTest, OfAllItNamesThoseWhoDoNotAnswer) {
  Robot("robot1", "hall", true);
  Robot("robot2", "yard", false);
  Robot("robot3", "yard", true, true);
  const auto words = Tell({{NowWhom::kAll, ""}}, milliseconds(4000));
  ASSERT_TRUE(words) << words.error().message;
  EXPECT_THAT(*words,
              ElementsAre(Field(&RobotsWord::robot, "robot1"), Field(&RobotsWord::robot, "robot2"),
                          Field(&RobotsWord::robot, "robot3")));
  EXPECT_EQ(WordsText(*words),
            "robot1: says robot1\nrobot2: did not answer\nrobot3: does not obey: says robot3\n");
  EXPECT_EQ(WordsJson(*words)[1].dump(),
            R"({"robot":"robot2","answered":false,"obeys":false,"detail":""})");
}

TEST_F(NowClientTest, SaysItAgainUntilItIsAnswered) {
  Robot("robot1", "hall", true, false, 3);
  const auto words = Tell({{NowWhom::kRobot, "robot1"}});
  ASSERT_TRUE(words);
  EXPECT_EQ(heard_, 4);
  EXPECT_EQ(WordsText(*words), "robot1: says robot1\n");
}

TEST_F(NowClientTest, WhoIsNamedAndNotThereDidNotAnswer) {
  const auto words = Tell({{NowWhom::kRobot, "nobody"}}, milliseconds(300));
  ASSERT_TRUE(words);
  EXPECT_EQ(WordsText(*words), "nobody: did not answer\n");
}

TEST_F(NowClientTest, TakesNoAnswerToWhatAnotherProcessOfItsNameSaid) {
  const auto robot = bus_.Open(exchange::FollowerTopics());
  std::thread other([&] {
    while (!ending_) {
      (void)robot->Publish(exchange::NowAnswer{
          .agent = AgentId("robot1"), .client = AgentId("desk"), .number = 1, .detail = "old"});
      std::this_thread::yield();
    }
  });
  const auto words = Tell({{NowWhom::kRobot, "robot1"}}, milliseconds(500));
  ending_ = true;
  other.join();
  ASSERT_TRUE(words);
  EXPECT_EQ(WordsText(*words), "robot1: did not answer\n");
}

TEST_F(NowClientTest, WhereNobodyIsHeardThatIsSaid) {
  const auto words = Tell({{NowWhom::kOnRoute, "hall"}}, milliseconds(300));
  ASSERT_FALSE(words);
  EXPECT_EQ(words.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(words.error().message, HasSubstr("no robot that this is meant for was heard"));
}

}  // namespace
}  // namespace trailcast::fleet
