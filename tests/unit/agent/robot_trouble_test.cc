// What the fleet hears of a follower whose robot falls silent on the way.
#include <gtest/gtest.h>

#include <functional>
#include <future>

#include "tests/unit/agent/driven_device.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using exchange::AgentMode;
using exchange::AgentStatus;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kTaughtFrames = 150;  // 3 m
constexpr std::chrono::seconds kBound{60};

// Gives no frames while it is silent, and tells whom it was asked to.
class SilentDevice : public test::DrivenDevice {
 public:
  std::atomic<bool> silent = false;

  Result<std::optional<Observation>> Next() override {
    if (silent) tell_("camera /robot1/image_raw: no picture for 0.3 s");
    const bool was_silent = silent;
    while (silent) std::this_thread::sleep_for(milliseconds(1));
    if (was_silent) tell_("");
    return DrivenDevice::Next();
  }
  void OnTrouble(const Trouble& tell) override { tell_ = tell; }

 private:
  Trouble tell_;
};

TEST(RobotTrouble, IsInTheAgentsStatusUntilItIsOver) {
  test::Swarm swarm;
  test::WalkDevice scout(kTaughtFrames);
  auto teach = swarm.ScoutNamed("server");
  ASSERT_TRUE(swarm.Teach(scout, teach, false));
  swarm.StartServer();
  const auto watcher = swarm.Join(exchange::OperatorTopics());
  const auto see = [&](const std::function<bool(const AgentStatus&)>& wanted) {
    const auto deadline = steady_clock::now() + kBound;
    while (steady_clock::now() < deadline) {
      for (const auto& message : watcher->Take(milliseconds(50))) {
        const auto* status = std::get_if<AgentStatus>(&message);
        if (status != nullptr && status->agent == AgentId("robot1") && wanted(*status)) return true;
      }
    }
    return false;
  };
  SilentDevice device;
  const auto options = swarm.FollowerNamed("robot1");
  auto run = std::async(std::launch::async, [&] { return swarm.Replay(device, options, true); });
  EXPECT_TRUE(see([](const AgentStatus& status) { return status.mode == AgentMode::kReplaying; }));
  device.silent = true;
  EXPECT_TRUE(see([](const AgentStatus& status) {
    return status.mode == AgentMode::kFault && status.speed_mps == 0.0 &&
           status.detail == "camera /robot1/image_raw: no picture for 0.3 s";
  }));
  device.silent = false;
  EXPECT_TRUE(see([](const AgentStatus& status) { return status.mode == AgentMode::kReplaying; }));
  const auto ended = run.get();
  ASSERT_TRUE(ended) << ended.error().message;
  EXPECT_EQ(ended->state, "ARRIVED") << ended->reason;
}

}  // namespace
}  // namespace trailcast::agent
