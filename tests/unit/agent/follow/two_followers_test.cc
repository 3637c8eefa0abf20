// Two followers on one route, each with a robot that does as it is told.
#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <vector>

#include "tests/support/await.h"
#include "tests/unit/agent/driven_device.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using exchange::AgentMode;
using exchange::AgentStatus;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test::DrivenDevice;

constexpr int kTaughtFrames = 150;  // 3 m
constexpr double kDistance_m = 0.8;
constexpr std::chrono::seconds kNever{3600};

class TwoFollowersTest : public testing::Test {
 protected:
  TwoFollowersTest() {
    test::WalkDevice scout(kTaughtFrames);
    auto options = swarm_.ScoutNamed("server");
    EXPECT_TRUE(swarm_.Teach(scout, options, false));
    swarm_.StartServer();
  }
  using Run = std::shared_future<Result<ReplayOutcome>>;

  Run Start(const std::string& name, DrivenDevice& device,
            std::chrono::seconds stuck_after = std::chrono::seconds(6)) {
    FollowerOptions options = swarm_.FollowerNamed(name);
    options.keep_distance.distance_m = kDistance_m;
    options.stuck_after = stuck_after;
    options.link.stop = [this] { return over_.load(); };
    Run run = std::async(std::launch::async,
                         [this, options, &device] { return swarm_.Replay(device, options, true); });
    return runs_.emplace_back(run);
  }
  // Waits until an operator sees one of the agents as wanted.
  bool See(const std::function<bool(const AgentStatus&)>& wanted) {
    const auto deadline = steady_clock::now() + test::kLongEnough;
    while (steady_clock::now() < deadline) {
      for (const auto& message : watcher_->Take(milliseconds(50))) {
        const auto* status = std::get_if<AgentStatus>(&message);
        if (status == nullptr) continue;
        last_ = *status;
        if (wanted(*status)) return true;
      }
    }
    return false;
  }
  bool SeeAt(const std::string& agent, double along_m) {
    return See([&](const AgentStatus& status) {
      return status.agent == AgentId(agent) && status.place && status.place->along_m >= along_m;
    });
  }
  bool SeeWaiting(const std::string& agent, const std::string& saying) {
    return See([&](const AgentStatus& status) {
      return status.agent == AgentId(agent) && status.mode == AgentMode::kWaiting &&
             status.detail.find(saying) != std::string::npos;
    });
  }
  // The runs outlive a test that failed half-way, and end here.
  ~TwoFollowersTest() override { over_ = true; }

  test::Swarm swarm_;
  std::unique_ptr<exchange::RouteExchange> watcher_ = swarm_.Join(exchange::OperatorTopics());
  AgentStatus last_;
  std::atomic<bool> over_{false};
  DrivenDevice first_;
  DrivenDevice second_;
  std::vector<Run> runs_;
};

TEST_F(TwoFollowersTest, TheSecondStopsBehindTheFirstAndBothGoOnAfter) {
  constexpr double kStopped_m = 1.8;
  first_.wall_m = kStopped_m;
  auto first = Start("first", first_, kNever);
  ASSERT_TRUE(SeeAt("first", kStopped_m - 0.1));
  auto second = Start("second", second_);
  ASSERT_TRUE(SeeWaiting("second", "waits for first")) << last_.detail;
  EXPECT_LE(second_.along_m, kStopped_m - kDistance_m + 0.1);
  EXPECT_GE(second_.along_m, kStopped_m - kDistance_m - 0.3);
  EXPECT_EQ(last_.speed_mps, 0.0);
  first_.wall_m = 1e9;
  const auto& first_ended = first.get();
  ASSERT_TRUE(first_ended) << first_ended.error().message;
  EXPECT_EQ(first_ended->state, "ARRIVED") << first_ended->reason;
  const auto& second_ended = second.get();
  ASSERT_TRUE(second_ended) << second_ended.error().message;
  EXPECT_EQ(second_ended->state, "ARRIVED") << second_ended->reason;
}

TEST_F(TwoFollowersTest, ANeighbourThatIsWaitedForLongIsNoReasonToGiveUp) {
  constexpr double kStopped_m = 1.8;
  first_.wall_m = kStopped_m;
  // Time for the second to come up to it.
  auto first = Start("first", first_, std::chrono::seconds(15));
  ASSERT_TRUE(SeeAt("first", kStopped_m - 0.1));
  auto second = Start("second", second_);
  ASSERT_TRUE(SeeWaiting("second", "waits for first")) << last_.detail;
  // The first gives up: stuck. Its robot stands in the way as before.
  const auto& first_ended = first.get();
  ASSERT_TRUE(first_ended) << first_ended.error().message;
  EXPECT_EQ(first_ended->state, "STUCK");
  ASSERT_TRUE(SeeWaiting("second", "not heard for")) << last_.detail;
  EXPECT_LE(second_.along_m, kStopped_m - kDistance_m + 0.1);
  over_ = true;
  EXPECT_EQ(second.get()->state, "STOPPED");
}

// Side by side, neither can get away before it has heard of the other.
TEST_F(TwoFollowersTest, OfTwoAtOnePlaceTheFirstByNameGoesFirst) {
  constexpr double kSideBySide_m = 0.1;
  first_.wall_m = second_.wall_m = kSideBySide_m;
  auto second = Start("second", second_, kNever);
  ASSERT_TRUE(SeeAt("second", 0.0));
  auto first = Start("first", first_, kNever);
  EXPECT_TRUE(SeeWaiting("second", "waits for first")) << last_.detail;
  first_.wall_m = second_.wall_m = 1e9;
  EXPECT_EQ(first.get()->state, "ARRIVED");
  EXPECT_EQ(second.get()->state, "ARRIVED");
}

}  // namespace
}  // namespace trailcast::agent
