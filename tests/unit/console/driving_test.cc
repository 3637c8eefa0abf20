#include "services/console/driving.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::console {
namespace {

using std::chrono::milliseconds;
using testing::IsEmpty;
using testing::SizeIs;
using Verdict = Driving::Verdict;

class DrivingTest : public testing::Test {
 protected:
  DrivingTest() {
    for (const char* robot : {"robot1", "robot2"}) Hear(robot, exchange::AgentMode::kTeaching);
  }
  void Hear(const std::string& robot, exchange::AgentMode mode) {
    exchange::AgentStatus status;
    status.agent = AgentId(robot);
    status.role = exchange::AgentRole::kFollower;
    status.mode = mode;
    driving_.Note(status, now_);
  }
  Verdict Say(const std::string& robot, double linear_mps, std::uint64_t said_ms,
              const std::string& driver = "ann") {
    return driving_.Hear(AgentId(robot), {linear_mps, 0.0, driver, said_ms}, now_);
  }
  std::vector<exchange::DriveCommand> Take() { return driving_.Take(AgentId("desk")); }

  Driving driving_;
  Driving::Time now_{std::chrono::hours(9)};
};

TEST_F(DrivingTest, OfWhatWaitsTheLatestWins) {
  EXPECT_EQ(Say("robot1", 0.1, 1000), Verdict::kGood);
  EXPECT_EQ(Say("robot1", 0.2, 1001), Verdict::kGood);
  EXPECT_EQ(Say("robot2", 0.3, 7), Verdict::kGood);
  const auto commands = Take();
  ASSERT_THAT(commands, SizeIs(2));
  EXPECT_EQ(commands[0].agent, AgentId("robot1"));
  EXPECT_EQ(commands[0].client, AgentId("desk"));
  EXPECT_EQ(commands[0].linear_mps, 0.2);
  EXPECT_EQ(commands[1].linear_mps, 0.3);
  EXPECT_THAT(Take(), IsEmpty());
}

TEST_F(DrivingTest, WhatWasUnderWayForLongIsAsOldToTheRobot) {
  EXPECT_EQ(Say("robot1", 0.1, 1000), Verdict::kGood);
  const std::uint64_t first_ms = Take().front().sent_ms;
  now_ += milliseconds(350);
  EXPECT_EQ(Say("robot1", 0.1, 1100), Verdict::kGood);
  EXPECT_NEAR(static_cast<double>(Take().front().sent_ms - first_ms), 100.0, 2.0);
  now_ += milliseconds(700);
  EXPECT_EQ(Say("robot1", 0.1, 1200), Verdict::kLate);
  EXPECT_THAT(Take(), IsEmpty());
}

TEST_F(DrivingTest, OfTwoPagesTheFirstDrives) {
  EXPECT_EQ(Say("robot1", 0.1, 1000), Verdict::kGood);
  EXPECT_EQ(Say("robot1", 0.9, 5, "bob"), Verdict::kTaken);
  EXPECT_EQ(Say("robot2", 0.9, 6, "bob"), Verdict::kGood);
  now_ += milliseconds(1000);
  EXPECT_EQ(Say("robot1", 0.9, 1005, "bob"), Verdict::kGood);
}

TEST_F(DrivingTest, WhoIsNotThereOrTeachesNothingIsNotDriven) {
  EXPECT_EQ(Say("robot9", 0.1, 1000), Verdict::kUnknown);
  Hear("robot2", exchange::AgentMode::kWaiting);
  EXPECT_EQ(Say("robot2", 0.1, 1000), Verdict::kTeachesNothing);
  now_ += Driving::kHeardWithin + milliseconds(1);
  EXPECT_EQ(Say("robot1", 0.1, 1000), Verdict::kUnknown) << "it is heard no more";
  EXPECT_THAT(Take(), IsEmpty());
}

}  // namespace
}  // namespace trailcast::console
