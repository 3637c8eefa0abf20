#include "services/tool/robot_checkup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::tool {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Grade = Finding::Grade;

class RobotCheckupTest : public testing::Test {
 protected:
  RobotCheckupTest() {
    topics_.robot = "/robot1";
    measures_.peers = {1, 1, 1, "", "the network's interface and the loopback"};
    measures_.pictures = measures_.odometry = 90;
    measures_.picture_rate_hz = measures_.odometry_rate_hz = 30.0;
    measures_.width_px = 320;
    measures_.height_px = 240;
    measures_.picture = {120.0, 50.0, 0.5};
    measures_.clocks_apart_s = 0.05;
    measures_.turn = agent::TurnMeasures{0.6, 0.58, 0.5, 0.0, 0.15, 0.02};
  }
  // Returns what is said of it, if anything is wrong.
  std::string Complaints() {
    std::vector<Finding> findings = JudgeRobot(measures_, topics_);
    std::erase_if(findings, [](const Finding& each) { return each.grade == Grade::kGood; });
    return CheckupText(findings);
  }

  dds::Ros2Options topics_;
  agent::RobotMeasures measures_;
};

TEST_F(RobotCheckupTest, FindsNothingWrongWithAGoodRobot) {
  EXPECT_EQ(Complaints(), "");
  EXPECT_EQ(JudgeRobot(measures_, topics_).size(), 6U);
}

TEST_F(RobotCheckupTest, JudgesTheScannerOfARobotThatHasOne) {
  topics_.scan = "scan";
  EXPECT_THAT(Complaints(), HasSubstr("BAD   scan /robot1/scan: nobody publishes it"));
  measures_.peers.scanners = 1;
  EXPECT_THAT(Complaints(), HasSubstr("BAD   scan /robot1/scan: nothing came that can be one"));
  measures_.scan = {30, 10.0, 360, 200, 0};
  EXPECT_EQ(Complaints(), "");
  measures_.scan.rate_hz = 2.0;
  EXPECT_THAT(Complaints(),
              AllOf(HasSubstr("scan /robot1/scan: 2 a second"), HasSubstr("--sensor-timeout")));
  measures_.scan = {30, 10.0, 360, 0, 0};
  EXPECT_THAT(Complaints(), HasSubstr("0 of 360 ranges see something"));
  measures_.scan = {30, 10.0, 360, 200, 12, {0.1, -0.2}};
  EXPECT_THAT(Complaints(),
              AllOf(HasSubstr("BAD   scan"),
                    HasSubstr("12 of them within the robot itself, one 0.10 m ahead of its axle, "
                              "0.20 m to the right"),
                    HasSubstr("--robot-width")));
}

TEST_F(RobotCheckupTest, JudgesEachOfItsRangeSensors) {
  topics_.ranges = {"left", "right"};
  measures_.ranges.resize(2);
  measures_.ranges[0] = {30, 10.0, {0.5, 0.02, 4.0, 1.5F}};
  EXPECT_THAT(Complaints(), AllOf(HasSubstr("BAD   range /robot1/right: nobody publishes it"),
                                  Not(HasSubstr("/robot1/left"))));
  const auto findings = JudgeObstacleSensors(measures_, topics_);
  EXPECT_THAT(CheckupText(findings), HasSubstr("sees something at 1.50 m, a cone of 29 degrees"));
}

TEST_F(RobotCheckupTest, TellsWhoIsMissingAndWhereItLooked) {
  measures_ = {};
  measures_.peers.tried = "the loopback";
  EXPECT_THAT(Complaints(), AllOf(HasSubstr("BAD   topics: no picture came on /robot1/image_raw"),
                                  HasSubstr("looked on the loopback"), Not(HasSubstr("picture:"))));
}

TEST_F(RobotCheckupTest, TellsABaseThatNobodyDrives) {
  measures_.peers.bases = 0;
  EXPECT_THAT(Complaints(), AllOf(HasSubstr("nobody listens to /robot1/cmd_vel as TwistStamped"),
                                  HasSubstr("--cmd-vel-type")));
}

TEST_F(RobotCheckupTest, TellsDarkBlandAndBlurredPictures) {
  measures_.picture = {10.0, 50.0, 0.5};
  EXPECT_THAT(Complaints(), HasSubstr("it is dark"));
  measures_.picture = {120.0, 5.0, 0.5};
  EXPECT_THAT(Complaints(), HasSubstr("it is bland"));
  measures_.picture = {120.0, 50.0, 0.26};
  EXPECT_THAT(Complaints(), HasSubstr("focus the lens"));
}

TEST_F(RobotCheckupTest, TellsStampsThatDisagree) {
  measures_.clocks_apart_s = -1.5;
  EXPECT_THAT(Complaints(), HasSubstr("pictures' are 1.50 s behind odometry's"));
  measures_.clocks_apart_s = 0.1;
  measures_.turn->stamps_late_s = 0.2;
  EXPECT_THAT(Complaints(), HasSubstr("pictures are stamped 0.20 s later than odometry"));
  measures_.odometry_stamps_stand = true;
  EXPECT_THAT(Complaints(), HasSubstr("those of odometry stand still"));
}

TEST_F(RobotCheckupTest, TellsWhichPartTurnsTheOtherWay) {
  measures_.turn->picture_share = -0.5;
  EXPECT_THAT(Complaints(), HasSubstr("is the camera upside down"));
  measures_.turn->odometry_rad = -0.58;
  EXPECT_THAT(Complaints(), HasSubstr("turn the sign of angular.z"));
  measures_.turn->picture_share = 0.5;
  EXPECT_THAT(Complaints(), HasSubstr("odometry counts turns the wrong way"));
  measures_.turn = agent::TurnMeasures{0.6, 0.0, 0.0, 0.0, std::nullopt, std::nullopt};
  EXPECT_THAT(Complaints(), HasSubstr("the base stands"));
}

TEST_F(RobotCheckupTest, TellsACameraThatStandsOnItsSide) {
  measures_.turn->picture_share = 0.05;
  measures_.turn->picture_down_share = -0.5;
  EXPECT_THAT(Complaints(), HasSubstr("on its side; turn it, or add 90 to --camera-roll"));
  measures_.turn->picture_down_share = 0.5;
  EXPECT_THAT(Complaints(), HasSubstr("add 270 to --camera-roll"));
}

TEST_F(RobotCheckupTest, TellsALongDelay) {
  measures_.turn->base_delay_s = 0.8;
  EXPECT_THAT(Complaints(), HasSubstr("drive slower"));
}

}  // namespace
}  // namespace trailcast::tool
