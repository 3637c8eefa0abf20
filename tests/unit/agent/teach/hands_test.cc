#include "agent/teach/hands.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using motion::VelocityCommand;
using std::chrono::milliseconds;

class HandsTest : public testing::Test {
 protected:
  void Drive(const std::string& client, double linear_mps, double turn_radps = 0.0) {
    said_ms_ += 1;
    hands_.Hear({AgentId("robot1"), AgentId(client), linear_mps, turn_radps, said_ms_}, now_);
    hands_.Take();
  }
  Hands hands_;
  Hands::Time now_{std::chrono::hours(1)};
  std::uint64_t said_ms_ = 5000;
};

TEST_F(HandsTest, NobodyDrivesWhoHasNotSaidSo) {
  hands_.Take();
  EXPECT_EQ(hands_.Wanted(now_), std::nullopt);
}

TEST_F(HandsTest, ARobotWhoseDriverFallsSilentStandsAndIsThenLetBe) {
  Drive("ann", 0.4, -0.2);
  EXPECT_EQ(hands_.Wanted(now_ + milliseconds(299)), (VelocityCommand{0.4, -0.2}));
  EXPECT_EQ(hands_.Wanted(now_ + milliseconds(300)), VelocityCommand{});
  EXPECT_EQ(hands_.Wanted(now_ + milliseconds(1000)), std::nullopt) << "somebody else may drive";
}

TEST_F(HandsTest, WordsThatLayInTheMailboxAreNoYoungerForThat) {
  hands_.Hear({AgentId("robot1"), AgentId("ann"), 0.4, 0.0, 1}, now_);
  now_ += milliseconds(400);
  hands_.Take();
  EXPECT_EQ(hands_.Wanted(now_), VelocityCommand{});
}

TEST_F(HandsTest, ASecondDriverIsNotObeyed) {
  Drive("ann", 0.4);
  Drive("bob", -0.4);
  EXPECT_EQ(hands_.Wanted(now_), (VelocityCommand{0.4, 0.0}));
}

TEST_F(HandsTest, AHeldRobotStandsWhoeverDrivesAndWhenNobodyDoes) {
  Hold paused{.kind = Hold::Kind::kPaused, .text = "paused by desk"};
  hands_.Tell(paused);
  Drive("ann", 0.4);
  EXPECT_EQ(hands_.Wanted(now_), VelocityCommand{});
  EXPECT_EQ(hands_.Wanted(now_ + std::chrono::hours(1)), VelocityCommand{});
  hands_.Tell({});
  hands_.Take();
  EXPECT_EQ(hands_.Wanted(now_), (VelocityCommand{0.4, 0.0}));
}

}  // namespace
}  // namespace trailcast::agent
