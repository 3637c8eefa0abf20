#include "services/odometry/odometry_worth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "services/base/square.h"

namespace trailcast::odometry {
namespace {

using testing::IsEmpty;

constexpr double kRate_hz = 20.0;
constexpr double kStep_s = 1.0 / kRate_hz;
constexpr double kSpeed_mps = 0.5;

// Stands for two seconds, then drives bends to either side, of several lengths, and stands again.
double TurnRateAt(double t_s) {
  if (t_s < 2.0 || t_s > 28.0) return 0.0;
  return 0.5 * std::sin(1.1 * t_s) + 0.4 * std::sin(0.37 * t_s);
}
double SpeedAt(double t_s) { return t_s < 2.0 || t_s > 28.0 ? 0.0 : kSpeed_mps; }

// This is what odometry tells instead of that motion at that time, for each second.
using Lie = std::function<motion::VelocityCommand(double t_s)>;
motion::VelocityCommand Truth(double t_s) { return {SpeedAt(t_s), TurnRateAt(t_s)}; }

// Thirty seconds, by a camera that magnifies `picture` times as the one that is taken.
std::vector<DriveStep> Drive(const Lie& odometry, double picture = 1.0) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<DriveStep> steps;
  for (int i = 1; i <= 600; ++i) {
    const double t_s = i * kStep_s;
    const motion::VelocityCommand drives = Truth(t_s);
    const motion::VelocityCommand told = odometry(t_s);
    PictureStep seen;
    seen.turn_rad = picture * (drives.angular_radps * kStep_s + 2e-4 * noise(random));
    seen.growth = 0.3 * drives.linear_mps * kStep_s;
    seen.flow = 0.1 * drives.linear_mps * kStep_s + std::abs(0.8 * seen.turn_rad);
    DriveStep step;
    step.t_s = 100.0 + t_s;
    step.dt_s = kStep_s;
    step.picture = seen;
    step.moved = {told.linear_mps * kStep_s, told.angular_radps * kStep_s};
    steps.push_back(step);
  }
  return steps;
}

TEST(OdometryWorth, OfGoodOdometryNothingIsComplainedOf) {
  const OdometryWorth worth = Weigh(Drive(Truth), std::nullopt);
  ASSERT_TRUE(worth.late);
  EXPECT_NEAR(worth.late->s, 0.0, 0.011);
  ASSERT_TRUE(worth.turn);
  EXPECT_NEAR(worth.turn->scale, 1.0, 0.01);
  EXPECT_NEAR(worth.turn->least_scale, 1.0, 0.03);
  EXPECT_NEAR(worth.turn->most_scale, 1.0, 0.03);
  EXPECT_NEAR(worth.turn->drift_radps, 0.0, 0.003);
  EXPECT_LT(worth.turn->noise_radps, 0.01);
  EXPECT_THAT(worth.spells, IsEmpty());
  EXPECT_THAT(worth.breaks_s, IsEmpty());
  ASSERT_TRUE(worth.standing_drift_radps);
  EXPECT_NEAR(*worth.standing_drift_radps, 0.0, 1e-6);
  EXPECT_NEAR(worth.driven_m, 26.0 * kSpeed_mps, 0.1);
  EXPECT_NEAR(worth.lasts_s, 30.0, 1e-6);
  EXPECT_NEAR(worth.seen_share, 1.0, 1e-9);
  EXPECT_FALSE(worth.told);
  EXPECT_FALSE(worth.whole_turn);
}

TEST(OdometryWorth, TellsHowLateItIs) {
  for (const double late_s : {-0.3, 0.2, 0.75}) {
    const auto worth = Weigh(Drive([&](double t_s) { return Truth(t_s - late_s); }), std::nullopt);
    ASSERT_TRUE(worth.late) << late_s;
    EXPECT_NEAR(worth.late->s, late_s, 0.02);
    ASSERT_TRUE(worth.turn);
    EXPECT_NEAR(worth.turn->scale, 1.0, 0.03) << "lateness is no scale";
    EXPECT_THAT(worth.spells, IsEmpty());
  }
}

TEST(OdometryWorth, TellsHowFarItsTurnsAreFromThePictures) {
  for (const double scale : {-1.0, 0.7, 1.25}) {
    const auto worth =
        Weigh(Drive([&](double t_s) {
                return motion::VelocityCommand{SpeedAt(t_s), scale * TurnRateAt(t_s)};
              }),
              std::nullopt);
    ASSERT_TRUE(worth.turn) << scale;
    EXPECT_NEAR(worth.turn->scale, scale, 0.02);
  }
  const auto worth = Weigh(Drive(Truth, 0.5), std::nullopt);
  ASSERT_TRUE(worth.turn);
  EXPECT_NEAR(worth.turn->scale, 2.0, 0.03) << "of a camera with half the focal length";
}

TEST(OdometryWorth, TellsTurnsThatChangeOnTheWay) {
  const auto worth = Weigh(
      Drive([](double t_s) {
        return motion::VelocityCommand{SpeedAt(t_s), (t_s < 15.0 ? 1.0 : 0.5) * TurnRateAt(t_s)};
      }),
      std::nullopt);
  ASSERT_TRUE(worth.turn);
  EXPECT_GT(worth.turn->most_scale, 1.6 * worth.turn->least_scale);
}

TEST(OdometryWorth, TellsAGyrosBiasAlsoWhileItStands) {
  const auto worth = Weigh(Drive([](double t_s) {
                             return motion::VelocityCommand{SpeedAt(t_s), TurnRateAt(t_s) + 0.05};
                           }),
                           std::nullopt);
  ASSERT_TRUE(worth.turn);
  EXPECT_NEAR(worth.turn->drift_radps, 0.05, 0.005);
  EXPECT_NEAR(worth.turn->scale, 1.0, 0.02);
  ASSERT_TRUE(worth.standing_drift_radps);
  EXPECT_NEAR(*worth.standing_drift_radps, 0.05, 1e-6);
}

TEST(OdometryWorth, FindsWhereItIsFrozen) {
  const auto worth =
      Weigh(Drive([](double t_s) {
              return t_s > 10.0 && t_s < 12.0 ? motion::VelocityCommand{} : Truth(t_s);
            }),
            std::nullopt);
  ASSERT_EQ(worth.spells.size(), 1U);
  EXPECT_EQ(worth.spells[0].kind, Spell::Kind::kFrozen);
  EXPECT_NEAR(worth.spells[0].from_s, 110.0, 0.2);
  EXPECT_NEAR(worth.spells[0].to_s, 112.0, 0.2);
  ASSERT_TRUE(worth.turn);
  EXPECT_NEAR(worth.turn->scale, 1.0, 0.02) << "it is not counted among the turns";
}

TEST(OdometryWorth, FindsWhereItMovesWhileThePictureStands) {
  const auto worth =
      Weigh(Drive([](double t_s) {
              return t_s > 28.5 && t_s < 29.5 ? motion::VelocityCommand{0.4, 0.0} : Truth(t_s);
            }),
            std::nullopt);
  ASSERT_EQ(worth.spells.size(), 1U);
  EXPECT_EQ(worth.spells[0].kind, Spell::Kind::kMovesAlone);
  EXPECT_NEAR(worth.spells[0].driven_m, 0.4, 0.05);
}

TEST(OdometryWorth, FindsWhereAWheelSpins) {
  const auto worth = Weigh(Drive([](double t_s) {
                             motion::VelocityCommand told = Truth(t_s);
                             if (t_s > 15.0 && t_s < 16.0) told.angular_radps -= 0.8;
                             return told;
                           }),
                           std::nullopt);
  ASSERT_EQ(worth.spells.size(), 1U);
  EXPECT_EQ(worth.spells[0].kind, Spell::Kind::kTurnsElse);
  EXPECT_NEAR(worth.spells[0].turned_rad, -0.8, 0.08);
  EXPECT_NEAR(0.5 * (worth.spells[0].from_s + worth.spells[0].to_s), 115.5, 0.2);
}

TEST(OdometryWorth, KeepsAJumpFromAllElse) {
  std::vector<DriveStep> steps = Drive(Truth);
  steps[299].odometry_broke = true;
  steps[299].moved = {};
  const auto worth = Weigh(steps, std::nullopt);
  EXPECT_THAT(worth.breaks_s, testing::ElementsAre(steps[299].t_s));
  EXPECT_THAT(worth.spells, IsEmpty());
}

TEST(OdometryWorth, OfAnotherDrivesOdometryItIsNotClearWhen) {
  const auto worth =
      Weigh(Drive([](double t_s) {
              return motion::VelocityCommand{SpeedAt(t_s), 0.6 * std::sin(1.9 * t_s * t_s / 20.0)};
            }),
            std::nullopt);
  EXPECT_FALSE(worth.late);
  EXPECT_FALSE(worth.turn);
}

TEST(OdometryWorth, NothingIsSaidOfTurnsWhereNothingTurns) {
  std::vector<DriveStep> steps = Drive([](double t_s) {
    return motion::VelocityCommand{SpeedAt(t_s), 0.0};
  });
  for (DriveStep& step : steps) step.picture->turn_rad = 0.0;
  const auto worth = Weigh(steps, std::nullopt);
  EXPECT_FALSE(worth.late);
  EXPECT_FALSE(worth.turn);
  EXPECT_THAT(worth.spells, IsEmpty());
}

TEST(OdometryWorth, WithoutPicturesThatCanBeFollowedNothingIsHeldAgainstIt) {
  std::vector<DriveStep> steps = Drive(Truth);
  for (DriveStep& step : steps) step.picture.reset();
  const auto worth = Weigh(steps, std::nullopt);
  EXPECT_DOUBLE_EQ(worth.seen_share, 0.0);
  EXPECT_FALSE(worth.late);
  EXPECT_FALSE(worth.standing_drift_radps);
  EXPECT_THAT(worth.spells, IsEmpty());
}

// Once round to the left, in 20 s, more slowly and faster.
std::vector<DriveStep> Round(double odometry_scale, double picture) {
  constexpr double kWhole_rad = 2.0 * std::numbers::pi;
  std::vector<DriveStep> steps;
  double before_rad = 0.0;
  for (int i = 1; i <= 400; ++i) {
    const double t_s = i * kStep_s;
    const double heading_rad = kWhole_rad * (t_s / 20.0 - 0.1 * std::sin(kWhole_rad * t_s / 5.0));
    DriveStep step;
    step.t_s = t_s;
    step.dt_s = kStep_s;
    step.picture = PictureStep{picture * (heading_rad - before_rad), 0.0, 0.01, 0.01};
    step.moved = {0.02, odometry_scale * (heading_rad - before_rad)};
    before_rad = heading_rad;
    steps.push_back(step);
  }
  return steps;
}

TEST(OdometryWorth, AWholeTurnTellsItsScaleWhateverTheCamera) {
  for (const double picture : {0.6, 1.0, 1.8}) {
    const auto worth = Weigh(Round(0.8, picture), CameBack{20.0, 0.0});
    ASSERT_TRUE(worth.whole_turn);
    EXPECT_NEAR(worth.whole_turn->odometry_rad, 0.8 * 2.0 * std::numbers::pi, 0.05);
    EXPECT_NEAR(worth.whole_turn->picture_rad, picture * 2.0 * std::numbers::pi, 0.05);
  }
  const auto worth = Weigh(Round(0.8, 1.0), CameBack{20.0, 0.1});
  ASSERT_TRUE(worth.whole_turn);
  EXPECT_LT(worth.whole_turn->odometry_rad, 0.8 * 2.0 * std::numbers::pi - 0.05)
      << "it has turned a little more than round";
}

TEST(OdometryWorth, APlaceThatLooksLikeTheFirstAfterHalfATurnIsNoWholeTurn) {
  EXPECT_FALSE(Weigh(Round(1.0, 1.0), CameBack{10.0, 0.0}).whole_turn);
}

TEST(OdometryWorth, ComingBackWithoutHavingTurnedIsNoWholeTurn) {
  EXPECT_FALSE(Weigh(Drive(Truth), CameBack{129.0, 0.0}).whole_turn);
}

TEST(OdometryWorth, HoldsMetresAgainstWhatTheBaseWasTold) {
  std::vector<DriveStep> steps = Drive([](double t_s) {
    return motion::VelocityCommand{1.3 * SpeedAt(t_s), TurnRateAt(t_s)};
  });
  for (DriveStep& step : steps) step.told = Truth(step.t_s - 100.0);
  const auto worth = Weigh(steps, std::nullopt);
  ASSERT_TRUE(worth.told);
  EXPECT_NEAR(worth.told->told_m, 13.0, 0.1);
  EXPECT_NEAR(worth.told->driven_m / worth.told->told_m, 1.3, 1e-6);
}

}  // namespace
}  // namespace trailcast::odometry
