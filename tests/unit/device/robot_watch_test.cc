#include "agent/device/src/robot_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using Part = RobotWatch::Trouble::Part;

constexpr milliseconds kTimeout{400};
constexpr milliseconds kFrame{33};
const motion::VelocityCommand kAhead{0.4, 0.0};

// A robot that senses every 33 ms, as long as its parts work.
class RobotWatchTest : public testing::Test {
 protected:
  void Run(milliseconds duration) {
    for (milliseconds passed{0}; passed < duration; passed += kFrame) {
      now_ += kFrame;
      stamp_ += kFrame;
      const double seconds = Seconds(kFrame);
      if (base_) {
        pose_ = motion::Advance(pose_, {told_.linear_mps * seconds, told_.angular_radps * seconds});
      }
      if (odometry_) watch_.SawOdometry(now_, stamp_, pose_);
      if (camera_) watch_.SawFrame(now_, picture_changes_);
      trouble_ = watch_.Check(now_);
      if (trouble_) return;
    }
  }
  // However long that takes of its own time, up to a minute.
  void RunUntilItIsOver() {
    const auto until = now_ + std::chrono::minutes(1);
    while (trouble_ && now_ < until) Run(kFrame);
    ASSERT_FALSE(trouble_);
  }
  void Tell(const motion::VelocityCommand& command) {
    told_ = command;
    watch_.Told(command);
  }

  RobotWatch watch_{kTimeout, true, false, 0};
  RobotWatch::Time now_{};
  SensorTime stamp_{};
  motion::Pose2 pose_;
  motion::VelocityCommand told_;
  bool camera_ = true;
  bool picture_changes_ = true;
  bool odometry_ = true;
  bool base_ = true;
  std::optional<RobotWatch::Trouble> trouble_;
};

TEST_F(RobotWatchTest, FindsNothingWrongWithARobotThatDrivesTurnsAndStands) {
  Run(milliseconds(2000));
  Tell(kAhead);
  Run(milliseconds(3000));
  Tell({0.0, -0.5});
  Run(milliseconds(3000));
  Tell({});
  Run(milliseconds(2000));
  EXPECT_FALSE(trouble_) << trouble_->what;
}

TEST_F(RobotWatchTest, MissesTheCameraAfterTheTimeout) {
  Tell(kAhead);
  Run(milliseconds(2000));
  camera_ = false;
  const auto began = now_;
  Run(milliseconds(2000));
  ASSERT_TRUE(trouble_);
  EXPECT_EQ(trouble_->part, Part::kCamera);
  EXPECT_LT(now_ - began, kTimeout + 2 * kFrame);
  camera_ = true;
  Run(kFrame);
  EXPECT_FALSE(trouble_);
}

TEST_F(RobotWatchTest, TakesTheSamePictureForFrozenOnlyWhileTheRobotDrives) {
  picture_changes_ = false;
  Run(milliseconds(3000));
  EXPECT_FALSE(trouble_) << trouble_->what;
  Tell(kAhead);
  Run(milliseconds(3000));
  ASSERT_TRUE(trouble_);
  EXPECT_EQ(trouble_->part, Part::kCamera);
  EXPECT_THAT(trouble_->what, HasSubstr("same picture"));
  Tell({});
  Run(milliseconds(3000));
  EXPECT_TRUE(trouble_) << "frozen until a picture changes";
  picture_changes_ = true;
  Run(kFrame);
  EXPECT_FALSE(trouble_);
}

TEST_F(RobotWatchTest, WaitsForABaseToGetGoingBeforeAPictureMustChange) {
  picture_changes_ = false;
  base_ = false;
  Tell(kAhead);
  Run(2 * kTimeout);
  EXPECT_FALSE(trouble_) << trouble_->what;
  base_ = true;
  Run(kFrame);
  EXPECT_FALSE(trouble_) << "the next picture may be the first from elsewhere";
  const auto began = now_;
  Run(2 * kTimeout);
  ASSERT_TRUE(trouble_);
  EXPECT_EQ(trouble_->part, Part::kCamera);
  EXPECT_LE(now_ - began, kTimeout + 2 * kFrame);
}

TEST_F(RobotWatchTest, WithoutOdometryARobotIsTakenToDoAsItIsTold) {
  watch_ = RobotWatch(kTimeout, false, false, 0);
  odometry_ = false;
  picture_changes_ = false;
  Tell(kAhead);
  Run(2 * kTimeout);
  ASSERT_TRUE(trouble_);
  EXPECT_EQ(trouble_->part, Part::kCamera);
}

TEST_F(RobotWatchTest, MissesTheOdometry) {
  Tell(kAhead);
  Run(milliseconds(2000));
  odometry_ = false;
  Run(milliseconds(2000));
  ASSERT_TRUE(trouble_);
  EXPECT_EQ(trouble_->part, Part::kOdometry);
}

TEST_F(RobotWatchTest, MissesTheScansOfARobotThatHasAScanner) {
  watch_ = RobotWatch(kTimeout, true, true, 0);
  Run(2 * kTimeout);
  EXPECT_FALSE(trouble_) << "the first is still to come";
  watch_.SawScan(now_);
  const auto began = now_;
  Run(2 * kTimeout);
  ASSERT_TRUE(trouble_);
  EXPECT_EQ(trouble_->part, Part::kScan);
  EXPECT_LE(now_ - began, kTimeout + 2 * kFrame);
}

TEST_F(RobotWatchTest, SaysWhichOfItsRangeSensorsIsMissed) {
  watch_ = RobotWatch(kTimeout, true, false, 2);
  watch_.SawRange(now_, 1);
  Run(kTimeout);
  watch_.SawRange(now_, 0);
  Run(kTimeout / 2);
  ASSERT_TRUE(trouble_);
  EXPECT_EQ(trouble_->part, Part::kRange);
  EXPECT_EQ(trouble_->sensor, 1U);
  EXPECT_EQ(trouble_->what, "no range for 0.4 s");
}

TEST_F(RobotWatchTest, NoticesABaseThatStopsObeying) {
  for (const motion::VelocityCommand& command : {kAhead, motion::VelocityCommand{0.0, 0.4}}) {
    watch_ = RobotWatch(kTimeout, true, false, 0);
    base_ = true;
    Tell({});
    Tell(command);
    Run(milliseconds(2000));
    ASSERT_FALSE(trouble_) << trouble_->what;
    base_ = false;
    const auto began = now_;
    Run(milliseconds(2000));
    ASSERT_TRUE(trouble_);
    EXPECT_EQ(trouble_->part, Part::kBase);
    EXPECT_EQ(watch_.base_stands_since(), now_);
    EXPECT_LT(now_ - began, kTimeout + 3 * kFrame);
  }
}

TEST_F(RobotWatchTest, HasABaseThatStandsTriedAgainUntilItMoves) {
  Tell(kAhead);
  Run(milliseconds(2000));
  base_ = false;
  Run(milliseconds(2000));
  ASSERT_TRUE(trouble_);
  const auto since = now_;
  for (const milliseconds rest : {milliseconds(1000), milliseconds(2000)}) {
    const auto stood = now_;
    Tell({});
    RunUntilItIsOver();
    EXPECT_GE(now_ - stood, rest);
    EXPECT_LE(now_ - stood, rest + 2 * kFrame);
    EXPECT_EQ(watch_.base_stands_since(), since) << "while it is tried, too";
    Tell(kAhead);
    Run(milliseconds(2000));
    ASSERT_TRUE(trouble_) << "it stands still";
  }
  Tell({});
  RunUntilItIsOver();
  base_ = true;
  Tell(kAhead);
  Run(milliseconds(2000));
  EXPECT_FALSE(trouble_);
  EXPECT_FALSE(watch_.base_stands_since());
}

TEST_F(RobotWatchTest, GivesABaseASecondToGetGoing) {
  base_ = false;
  Tell(kAhead);
  Run(milliseconds(800));
  EXPECT_FALSE(trouble_) << trouble_->what;
  base_ = true;
  Run(milliseconds(3000));
  EXPECT_FALSE(trouble_) << trouble_->what;
}

TEST_F(RobotWatchTest, DoesNotExpectACreepingRobotToGetAnywhere) {
  base_ = false;
  Tell({0.02, 0.05});
  Run(milliseconds(5000));
  EXPECT_FALSE(trouble_) << trouble_->what;
}

}  // namespace
}  // namespace trailcast::agent
