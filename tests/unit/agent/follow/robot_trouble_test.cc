// These test what the fleet hears of a follower whose robot falls silent on the way, or waits for
// somebody.
#include <gtest/gtest.h>

#include <functional>
#include <future>

#include "tests/support/await.h"
#include "tests/unit/agent/driven_device.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using exchange::AgentMode;
using exchange::AgentStatus;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kTaughtFrames = 150;  // 3 m
constexpr double kWall_m = 2.0;

// Gives no frames while it is silent, from half-way on, and tells whom it was asked to why.
class SilentDevice : public test::DrivenDevice {
 public:
  std::atomic<bool> heard_again = false;  // by whoever waits for it
  Halt why{"camera /robot1/image_raw: no picture for 0.3 s"};

  Result<std::optional<Observation>> Next() override {
    if (late_ == late_.zero() && along_m > kSilentFrom_m) {
      tell_(why);
      test::Await([this] { return heard_again.load(); }, "the robot to be heard again");
      tell_({});
      late_ += std::chrono::minutes(2);
    }
    auto seen = DrivenDevice::Next();
    if (seen && *seen) (*seen)->stamp += late_;
    return seen;
  }
  void OnTrouble(const Trouble& tell) override { tell_ = tell; }

 private:
  static constexpr double kSilentFrom_m = 1.0;
  Trouble tell_;
  std::chrono::nanoseconds late_{0};  // as long as it was silent, by its own clock
};

// Expects this in the status of an agent while its robot gives no frames.
void ExpectStatus(const RobotDevice::Halt& why, AgentMode mode) {
  test::Swarm swarm;
  test::WalkDevice scout(kTaughtFrames);
  auto teach = swarm.ScoutNamed("server");
  ASSERT_TRUE(swarm.Teach(scout, teach, false));
  swarm.StartServer();
  const auto watcher = swarm.Join(exchange::OperatorTopics());
  const auto see = [&](const std::function<bool(const AgentStatus&)>& wanted) {
    const auto deadline = steady_clock::now() + test::kLongEnough;
    while (steady_clock::now() < deadline) {
      for (const auto& message : watcher->Take(milliseconds(50))) {
        const auto* status = std::get_if<AgentStatus>(&message);
        if (status != nullptr && status->agent == AgentId("robot1") && wanted(*status)) return true;
      }
    }
    return false;
  };
  SilentDevice device;
  device.why = why;
  const auto options = swarm.FollowerNamed("robot1");
  auto run = std::async(std::launch::async, [&] { return swarm.Replay(device, options, true); });
  EXPECT_TRUE(see([&](const AgentStatus& status) {
    return status.mode == mode && status.speed_mps == 0.0 && status.detail == why.what;
  }));
  device.wall_m = kWall_m;  // no further before that is seen, too
  device.heard_again = true;
  EXPECT_TRUE(see([](const AgentStatus& status) { return status.mode == AgentMode::kReplaying; }));
  device.wall_m = 1e9;
  const auto ended = run.get();
  ASSERT_TRUE(ended) << ended.error().message;
  EXPECT_EQ(ended->state, "ARRIVED") << ended->reason;
}

TEST(RobotTrouble, IsInTheAgentsStatusUntilItIsOver) {
  ExpectStatus({"camera /robot1/image_raw: no picture for 0.3 s"}, AgentMode::kFault);
}

// However long that takes.
TEST(RobotTrouble, WhoStandsInTheWayMakesItWaitAndIsNoFault) {
  ExpectStatus({"something stands 0.3 m ahead, in the way: the robot waits", false},
               AgentMode::kWaiting);
}

}  // namespace
}  // namespace trailcast::agent
