#include "services/lab/trial/flaws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace trailcast::trial {
namespace {

using testing::HasSubstr;
using Kind = agent::RobotFault::Kind;

constexpr double kDrive_s = 40.0;

sim::CameraModel Webcam() { return *sim::FindCamera("webcam"); }

// All of a robot's flaws as one text, to compare robots by.
std::string Text(const RobotFlaws& robot) {
  std::string text = fmt::format(
      "{} {} {} {} {} {} {} {} {}", robot.camera.roll_deg, robot.camera.ahead_m,
      robot.camera.centre_u, robot.camera.centre_v, robot.camera.knock_yaw_deg,
      robot.camera.knock_at_s, robot.camera.exposure_swing, robot.camera.exposure_period_s,
      robot.camera.readout_s + robot.told_roll_deg + robot.told_ahead_m.value_or(0.0));
  text += fmt::format(" {} {} {} {} {}", robot.timing.picture_rate_hz, robot.timing.dropped,
                      robot.timing.picture_delay_s, robot.timing.base_delay_s,
                      robot.timing.stamps_late_s);
  for (const agent::RobotFault& fault : robot.faults) {
    text += fmt::format(" {}@{}", static_cast<int>(fault.kind), fault.spell.after_s);
  }
  return text;
}

TEST(Flaws, EachMakesAnotherRobotThanTheOneAsDrawn) {
  const std::string without = Text(DrawFlaws("", Webcam(), kDrive_s, 1));
  for (const std::string& name : FlawNames()) {
    EXPECT_NE(Text(DrawFlaws(name, Webcam(), kDrive_s, 1)), without) << name;
    EXPECT_TRUE(CheckFlaw(name)) << name;
  }
}

TEST(Flaws, AreDrawnFromTheSeedAlone) {
  EXPECT_EQ(Text(DrawFlaws("all", Webcam(), kDrive_s, 7)),
            Text(DrawFlaws("all", Webcam(), kDrive_s, 7)));
  EXPECT_NE(Text(DrawFlaws("all", Webcam(), kDrive_s, 7)),
            Text(DrawFlaws("all", Webcam(), kDrive_s, 8)));
}

TEST(Flaws, MakeNoCameraThatCannotBe) {
  for (const std::string& name : FlawNames()) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto possible = sim::Validate(DrawFlaws(name, Webcam(), kDrive_s, seed).camera);
      EXPECT_TRUE(possible) << name << ", seed " << seed << ": " << possible.error().message;
    }
  }
}

TEST(Flaws, HappenWhileTheRobotIsUnderWay) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const RobotFlaws robot = DrawFlaws("all", Webcam(), kDrive_s, seed);
    EXPECT_GE(robot.faults.size(), 7U);
    for (const agent::RobotFault& fault : robot.faults) {
      EXPECT_GT(fault.spell.after_s, 0.2 * kDrive_s);
      EXPECT_LT(fault.spell.after_s, 0.7 * kDrive_s);
    }
    EXPECT_EQ(std::abs(robot.camera.knock_yaw_deg), 5.0);
    EXPECT_GT(robot.camera.knock_at_s, 0.2 * kDrive_s);
  }
}

TEST(Flaws, ACameraAheadIsToldOnlyWhereItSaysSo) {
  const RobotFlaws untold = DrawFlaws("ahead", Webcam(), kDrive_s, 3);
  EXPECT_GE(untold.camera.ahead_m, 0.1);
  EXPECT_LE(untold.camera.ahead_m, 0.6);
  EXPECT_FALSE(untold.told_ahead_m);
  const RobotFlaws told = DrawFlaws("ahead-told", Webcam(), kDrive_s, 3);
  EXPECT_EQ(told.told_ahead_m, told.camera.ahead_m);
  EXPECT_FALSE(DrawFlaws("all", Webcam(), kDrive_s, 3).told_ahead_m);
}

TEST(Flaws, AnUnknownOneIsRefusedWithTheNamesThereAre) {
  const auto refused = CheckFlaw("rusty");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("no flaw 'rusty'"));
  EXPECT_THAT(refused.error().message, HasSubstr("upside-down"));
  EXPECT_THAT(refused.error().message, HasSubstr("all"));
}

}  // namespace
}  // namespace trailcast::trial
