#include "services/program/heartbeat.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "services/program/presence.h"
#include "tests/support/await.h"
#include "tests/support/temp_dir.h"

namespace trailcast::program {
namespace {

using exchange::AgentMode;
using std::chrono::milliseconds;
using testing::HasSubstr;

class HeartbeatTest : public testing::Test {
 protected:
  HeartbeatTest() {
    exchange_ = WithHeartbeat(bus_.Open(WithAgents(exchange::FollowerTopics())), file_);
    status_.agent = AgentId("robot1");
    status_.role = exchange::AgentRole::kFollower;
    status_.instance = 7;
  }
  void Say(AgentMode mode, const std::string& detail) {
    status_.mode = mode;
    status_.detail = detail;
    ASSERT_TRUE(exchange_->Publish(status_));
  }

  test::TempDir folder_;
  std::filesystem::path file_ = folder_ / "beat";
  exchange::InProcessBus bus_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
  exchange::AgentStatus status_;
};

TEST_F(HeartbeatTest, TellsWhatTheProcessDoes) {
  status_.route = "hall";
  status_.progress = 0.43;
  Say(AgentMode::kReplaying, "sure of the path");
  EXPECT_EQ(ReadHeartbeat(file_).value(), "robot1: 43 % of 'hall': sure of the path");
}

TEST_F(HeartbeatTest, AFaultIsKnownAtOnceAndNotWell) {
  Say(AgentMode::kReplaying, "");
  ASSERT_TRUE(ReadHeartbeat(file_));
  Say(AgentMode::kFault, "the camera gives no pictures");
  const auto words = ReadHeartbeat(file_);
  ASSERT_FALSE(words);
  EXPECT_THAT(words.error().message, HasSubstr("the camera gives no pictures"));
}

TEST_F(HeartbeatTest, TakingKeepsItYoungAndNothingElseDoes) {
  Say(AgentMode::kWaiting, "waiting for a route");
  constexpr milliseconds kStaleAfter{50};
  const auto deadline = std::chrono::steady_clock::now() + test::kLongEnough;
  const auto is_young = [&] { return ReadHeartbeat(file_, kStaleAfter).has_value(); };
  while (is_young() && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  EXPECT_THAT(ReadHeartbeat(file_, kStaleAfter).error().message,
              HasSubstr("it said: robot1: waiting for a route"));
  bool young_again = false;
  while (!young_again && std::chrono::steady_clock::now() < deadline) {
    (void)exchange_->Take(milliseconds(5));
    young_again = is_young();
  }
  EXPECT_TRUE(young_again);
}

TEST_F(HeartbeatTest, WithoutAFileThereIsNobody) {
  const auto words = ReadHeartbeat(folder_ / "none");
  ASSERT_FALSE(words);
  EXPECT_EQ(words.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace trailcast::program
