#include "services/lab/trial/recording/odometry_noise.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace trailcast::trial {
namespace {

using testing::HasSubstr;

constexpr double kRate_hz = 20.0;
constexpr double kSpeed_mps = 0.5;

// A robot that drives straight on for so long; what its odometry tells at the end.
motion::Pose2 DriveOn(const std::string& noise, double drive_s = 10.0, std::uint64_t seed = 1) {
  OdometrySpoiler spoiler(*ParseOdometryNoise(noise), drive_s, seed);
  motion::Pose2 told;
  for (int i = 0; i <= static_cast<int>(drive_s * kRate_hz); ++i) {
    const double t_s = i / kRate_hz;
    told = spoiler.Tell(FromSeconds(t_s), {kSpeed_mps * t_s, 0.0, 0.0});
  }
  return told;
}

TEST(OdometryNoise, WithoutAnyEveryPoseIsTold) {
  EXPECT_EQ(DriveOn("none").x_m, 5.0);
  EXPECT_EQ(DriveOn("").x_m, 5.0);
}

TEST(OdometryNoise, ScalesAndTurns) {
  EXPECT_NEAR(DriveOn("scale=1.4").x_m, 7.0, 1e-9);
  EXPECT_NEAR(DriveOn("drift=3").heading_rad, 15.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_NEAR(DriveOn("bias=0.1").heading_rad, 1.0, 1e-9);
  OdometrySpoiler turns(*ParseOdometryNoise("turn=0.5"), 10.0, 1);
  std::ignore = turns.Tell(FromSeconds(0.0), {0.0, 0.0, 0.0});
  EXPECT_NEAR(turns.Tell(FromSeconds(1.0), {0.1, 0.0, 0.8}).heading_rad, 0.4, 1e-9);
}

TEST(OdometryNoise, TellsWhatWas) {
  EXPECT_NEAR(DriveOn("delay=0.2").x_m, 5.0 - 0.2 * kSpeed_mps, 1e-9);
}

TEST(OdometryNoise, SomeOfItHappensOnce) {
  EXPECT_NEAR(DriveOn("frozen=2").x_m, 4.0, 0.03);
  const motion::Pose2 slipped = DriveOn("slips");
  EXPECT_GT(std::abs(slipped.heading_rad), 0.7);
  EXPECT_NEAR(std::hypot(DriveOn("jumps=1").x_m, DriveOn("jumps=1").y_m), 7.0, 1.5);
  EXPECT_NEAR(DriveOn("jumps=2").heading_rad, 2.0, 1e-9);
}

TEST(OdometryNoise, TheSameSeedGivesTheSame) {
  EXPECT_EQ(DriveOn("slips", 10.0, 7).y_m, DriveOn("slips", 10.0, 7).y_m);
  EXPECT_NE(DriveOn("slips", 10.0, 7).y_m, DriveOn("slips", 10.0, 8).y_m);
}

TEST(OdometryNoise, SaysWhatThereIs) {
  EXPECT_EQ(ParseOdometryNoise("scale=0.9+drift=-3")->size(), 2U);
  EXPECT_THAT(ParseOdometryNoise("wobbles").error().message, HasSubstr("there are: scale, turn"));
  EXPECT_THAT(ParseOdometryNoise("scale=x").error().message, HasSubstr("a number from 0 to 10"));
  EXPECT_THAT(OdometryNoiseHelp(), HasSubstr("frozen=2"));
}

}  // namespace
}  // namespace trailcast::trial
