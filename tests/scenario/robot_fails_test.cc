// Virtual robots that fail, and agents that stop them, or go on. How soon depends on what else the
// machine does.
#include <algorithm>
#include <limits>

#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RobotFailsTest : public RobotsTest {};

TEST_F(RobotFailsTest, WhateverFailsTheRobotIsToldToStandWithinHalfASecond) {
  Teach();
  struct Fault {
    const char* name;
    const char* said;
  };
  for (const Fault& fault : {Fault{"camera-freezes", "camera /robot1/image_raw: the same picture"},
                             Fault{"camera-stops", "camera /robot1/image_raw: no picture"},
                             Fault{"odometry-stops", "odometry /robot1/odom: no odometry"},
                             Fault{"base-stops", "base /robot1/cmd_vel: told to drive"}}) {
    SCOPED_TRACE(fault.name);
    constexpr double kSoon_s = 0.5;
    // A machine that stands for a moment may spoil a try.
    double soonest_s = std::numeric_limits<double>::infinity();
    for (int time = 0; time < 3 && soonest_s > kSoon_s; ++time) {
      const auto robot = Robot("robot1", {"--fail", fault.name + std::string("@2")});
      const auto follower = Follow({"--sensor-patience", "1", "--base-patience", "1"});
      EXPECT_EQ(End(*follower).status, 1);
      EXPECT_THAT(follower->output(), AllOf(HasSubstr("state=FAILED"), HasSubstr(fault.said)));
      robot->Signal(SIGTERM);
      ASSERT_EQ(End(*robot).status, 0) << robot->output();
      const double stopped_s = Number(robot->output(), "told_to_stand_after_s");
      EXPECT_GT(stopped_s, 0.0) << robot->output();
      soonest_s = std::min(soonest_s, stopped_s);
    }
    EXPECT_LE(soonest_s, kSoon_s);
  }
}

}  // namespace
}  // namespace trailcast::test
