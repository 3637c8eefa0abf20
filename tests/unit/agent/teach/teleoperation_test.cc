#include "agent/teach/teleoperation.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using motion::VelocityCommand;
using std::chrono::milliseconds;

class TeleoperationTest : public testing::Test {
 protected:
  void Drive(const std::string& client, double linear_mps, double turn_radps = 0.0) {
    said_ms_ += 1;
    teleoperation_.Hear({AgentId("robot1"), AgentId(client), linear_mps, turn_radps, said_ms_},
                        now_);
    teleoperation_.Take();
  }
  Teleoperation teleoperation_;
  Teleoperation::Time now_{std::chrono::hours(1)};
  std::uint64_t said_ms_ = 5000;
};

TEST_F(TeleoperationTest, NobodyDrivesWhoHasNotSaidSo) {
  teleoperation_.Take();
  EXPECT_EQ(teleoperation_.Wanted(now_), std::nullopt);
}

TEST_F(TeleoperationTest, ARobotWhoseDriverFallsSilentStandsAndIsThenLetBe) {
  Drive("ann", 0.4, -0.2);
  EXPECT_EQ(teleoperation_.Wanted(now_ + milliseconds(299)), (VelocityCommand{0.4, -0.2}));
  EXPECT_EQ(teleoperation_.Wanted(now_ + milliseconds(300)), VelocityCommand{});
  EXPECT_EQ(teleoperation_.Wanted(now_ + milliseconds(1000)), std::nullopt)
      << "somebody else may drive";
}

TEST_F(TeleoperationTest, WordsThatLayInTheMailboxAreNoYoungerForThat) {
  teleoperation_.Hear({AgentId("robot1"), AgentId("ann"), 0.4, 0.0, 1}, now_);
  now_ += milliseconds(400);
  teleoperation_.Take();
  EXPECT_EQ(teleoperation_.Wanted(now_), VelocityCommand{});
}

TEST_F(TeleoperationTest, ASecondDriverIsNotObeyed) {
  Drive("ann", 0.4);
  Drive("bob", -0.4);
  EXPECT_EQ(teleoperation_.Wanted(now_), (VelocityCommand{0.4, 0.0}));
}

TEST_F(TeleoperationTest, AHeldRobotStandsWhoeverDrivesAndWhenNobodyDoes) {
  Hold paused{.kind = Hold::Kind::kPaused, .text = "paused by desk"};
  teleoperation_.Tell(paused);
  Drive("ann", 0.4);
  EXPECT_EQ(teleoperation_.Wanted(now_), VelocityCommand{});
  EXPECT_EQ(teleoperation_.Wanted(now_ + std::chrono::hours(1)), VelocityCommand{});
  teleoperation_.Tell({});
  teleoperation_.Take();
  EXPECT_EQ(teleoperation_.Wanted(now_), (VelocityCommand{0.4, 0.0}));
}

}  // namespace
}  // namespace trailcast::agent
