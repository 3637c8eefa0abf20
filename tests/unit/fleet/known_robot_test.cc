#include "services/fleet/known_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "services/program/presence.h"
#include "tests/support/await.h"

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;

constexpr milliseconds kBriefly{300};

class KnownRobotTest : public testing::Test {
 protected:
  void TearDown() override {
    ending_ = true;
    for (std::thread& peer : peers_) peer.join();
  }
  void Robot(const std::string& name) {
    robots_.push_back(bus_.Open(program::WithAgents(exchange::FollowerTopics())));
    exchange::AgentStatus status;
    status.agent = AgentId(name);
    status.role = exchange::AgentRole::kFollower;
    ASSERT_TRUE(robots_.back()->Publish(status));
  }
  // `fill` says what the server has heard.
  void Server(std::function<void(exchange::MissionReply&)> fill) {
    peers_.emplace_back(
        [this, fill = std::move(fill),
         exchange = std::shared_ptr<exchange::RouteExchange>(bus_.Open(exchange::ServerTopics()))] {
          while (!ending_) {
            for (const exchange::Message& message : exchange->Take(milliseconds(10))) {
              const auto* asked = std::get_if<exchange::MissionRequest>(&message);
              if (asked == nullptr) continue;
              EXPECT_EQ(asked->query.agent, "robot1");
              exchange::MissionReply reply{
                  .server = AgentId("barn"), .client = asked->client, .request = asked->request};
              fill(reply);
              (void)exchange->Publish(reply);
            }
          }
        });
  }
  std::optional<Error> Find(milliseconds patience) {
    exchange::TopicUse use = exchange::HistoryTopics();
    use.read.push_back(exchange::Topic::kAgents);
    const auto desk = bus_.Open(use);
    return FindUnknown(*desk, AgentId("desk"), "robot1", patience);
  }
  void ExpectKnownAtOnce() {
    const auto began = std::chrono::steady_clock::now();
    const auto unknown = Find(2 * test::kLongEnough);
    EXPECT_FALSE(unknown) << unknown->message;
    EXPECT_LT(std::chrono::steady_clock::now() - began, test::kLongEnough);
  }

  exchange::InProcessBus bus_;
  std::atomic<bool> ending_{false};
  std::vector<std::unique_ptr<exchange::RouteExchange>> robots_;
  std::vector<std::thread> peers_;
};

TEST_F(KnownRobotTest, WhoIsHeardIsKnownAtOnce) {
  Robot("robot1");
  ExpectKnownAtOnce();
}

TEST_F(KnownRobotTest, WhomTheServerAloneHearsAsInAStarIsKnownAtOnce) {
  Server([](auto& reply) { reply.robots = {"robot1"}; });
  ExpectKnownAtOnce();
}

TEST_F(KnownRobotTest, WhoHasTakenAMissionOnceIsKnownAtOnce) {
  Server([](auto& reply) {
    reply.missions.push_back(
        {.mission = {.agent = AgentId("robot1"),
                     .id = "earlier",
                     .client = AgentId("other"),
                     .orders = "wait 1"},
         .last = {.agent = AgentId("robot1"), .mission = "earlier", .change = 1}});
  });
  ExpectKnownAtOnce();
}

TEST_F(KnownRobotTest, InAStarTheServerTellsWhoMayHaveBeenMeant) {
  Server([](auto& reply) { reply.robots = {"robot2", "crane"}; });
  const auto unknown = Find(kBriefly);
  ASSERT_TRUE(unknown);
  EXPECT_EQ(unknown->code, ErrorCode::kNotFound);
  EXPECT_THAT(unknown->message,
              AllOf(HasSubstr("no robot 'robot1' is known"), HasSubstr("did you mean 'robot2'?")));
}

TEST_F(KnownRobotTest, AServerThatHasHeardOfNobodyHasNotHeardOfItEither) {
  Server([](auto& /*reply*/) {});
  EXPECT_TRUE(Find(kBriefly));
}

TEST_F(KnownRobotTest, WhereNoServerAnswersOrOneCannotNothingIsKnown) {
  Robot("robot2");
  EXPECT_FALSE(Find(kBriefly));
  Server([](auto& reply) { reply.error = "busy"; });
  EXPECT_FALSE(Find(kBriefly));
}

}  // namespace
}  // namespace trailcast::fleet
