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
      ASSERT_TRUE(robot->WaitForOutput("in real time")) << robot->output();
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

TEST_F(RobotFailsTest, ARobotIsFollowedOverWhatRealOnesDo) {
  Teach();
  struct Life {
    const char* name;
    Words robot;
    Words said;
  };
  for (const Life& life :
       {Life{"safety stops",
             {"--fail", "base-stops@2+0.5", "--fail", "base-stops@4+4"},
             {"by its odometry it stands", "over: base /robot1/cmd_vel"}},
        Life{"odometry",
             {"--fail", "odometry-jumps@2", "--fail", "odometry-restarts@5"},
             {"odometry jumped by "}},
        Life{"clocks",
             {"--fail", "camera-clock-back@2", "--fail", "odometry-clock-back@4", "--fail",
              "camera-stamps-stand@6+1"},
             {"pictures: its clock went back by 5.0", "odometry: its clock went back by 5.0",
              "pictures: its stamps stand still"}},
        Life{"stamps of two clocks", {"--stamps-late", "1.5"}, {"different clocks, 1."}},
        Life{"delays", {"--picture-delay", "0.2", "--base-delay", "0.2"}, {}},
        Life{"few pictures", {"--picture-rate", "8", "--drop-pictures", "0.3"}, {}}}) {
    SCOPED_TRACE(life.name);
    const auto robot =
        Robot("robot1", With({"--sim-truth", Path("truth.csv"), "--seed", "3"}, life.robot));
    ASSERT_TRUE(robot->WaitForOutput("in real time")) << robot->output();
    const auto follower = Follow({});
    EXPECT_EQ(End(*follower).status, 0) << follower->output() << robot->output();
    EXPECT_THAT(follower->output(), HasSubstr("state=ARRIVED"));
    for (const std::string& word : life.said) EXPECT_THAT(follower->output(), HasSubstr(word));
    robot->Signal(SIGTERM);
    ASSERT_EQ(End(*robot).status, 0) << robot->output();
    const auto places = TruePlaces();
    ASSERT_FALSE(places.empty());
    EXPECT_NEAR(places.back().x_m, 4.5, 0.4);
    EXPECT_NEAR(places.back().y_m, 1.5, 0.25);
  }
}

}  // namespace
}  // namespace trailcast::test
