#include "services/teach/roll_by_turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "services/base/angles.h"

namespace trailcast::teach {
namespace {

constexpr int kWidth_px = 640;
constexpr double kFrame_s = 0.1;
constexpr double kTurn_rad = 0.03;  // in a frame

// A robot among features at many distances whose camera is rolled clockwise by so much; the
// features that it sees move by a turn, by driving on, and by themselves.
class Robot {
 public:
  explicit Robot(double roll_deg, double focal_share = 0.87)
      : roll_rad_(Radians(roll_deg)), focal_px_(focal_share * kWidth_px) {}

  // Frames in each of which it turns by `turned_rad`, and is said to turn by `told_rad`.
  void Turn(int frames, double turned_rad, double told_rad, int features = 40) {
    for (int i = 0; i < frames; ++i) {
      rolls.Add(Moved(turned_rad, features), told_rad, kFrame_s, kWidth_px);
    }
  }
  void Turn(int frames, double turned_rad) { Turn(frames, turned_rad, turned_rad); }

  double ahead = 0.01;  // by how much all grows in a frame
  double aside_px = 0.0;
  double swings_px = 0.0;  // of the picture, up and down
  int wild = 8;            // features that move as they like
  RollByTurns rolls;

 private:
  std::vector<MovedFeature> Moved(double turned_rad, int features) {
    std::vector<MovedFeature> moved;
    const double swing_px = swings_px * std::sin(0.9 * frame_++);
    for (int i = 0; i < features; ++i) {
      const double u_px = place_(random_);
      const double v_px = 0.7 * place_(random_);
      const double grows = ahead * std::exp(near_(random_));
      const bool strays = i < wild;
      const double right_px =
          strays ? 0.1 * place_(random_)
                 : focal_px_ * turned_rad + grows * u_px + aside_px + noise_(random_);
      const double down_px =
          strays ? 0.1 * place_(random_) : grows * v_px + swing_px + noise_(random_);
      const route::TrackedFeature before = Seen(i, u_px, v_px);
      moved.push_back({before, Seen(i, u_px + right_px, v_px + down_px)});
    }
    return moved;
  }
  // A camera that is rolled clockwise sees things further counter-clockwise in its picture.
  [[nodiscard]] route::TrackedFeature Seen(int id, double right_px, double down_px) const {
    const double cosine = std::cos(roll_rad_);
    const double sine = std::sin(roll_rad_);
    return {id, cosine * right_px + sine * down_px, cosine * down_px - sine * right_px};
  }

  double roll_rad_;
  double focal_px_;
  int frame_ = 0;
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> place_{-300.0, 300.0};
  std::normal_distribution<double> near_{0.0, 0.5};
  std::normal_distribution<double> noise_{0.0, 0.2};
};

TEST(RollByTurns, TellsEachQuarterTurnByATurnToEitherSide) {
  for (const double roll_deg : {0.0, 90.0, 180.0, 270.0}) {
    for (const double turn_rad : {kTurn_rad, -kTurn_rad}) {
      Robot robot(roll_deg);
      robot.Turn(14, turn_rad);
      EXPECT_EQ(robot.rolls.roll_deg(), roll_deg) << turn_rad;
    }
  }
}

TEST(RollByTurns, TellsItOfACameraThatIsCrookedBesidesAndOfAnyLens) {
  for (const double crooked_deg : {-20.0, 20.0}) {
    for (const double focal_share : {0.35, 2.0}) {
      Robot robot(180.0 + crooked_deg, focal_share);
      robot.Turn(20, 0.02);
      EXPECT_EQ(robot.rolls.roll_deg(), 180.0) << crooked_deg << " " << focal_share;
    }
  }
}

TEST(RollByTurns, TheShakesOfALiveDriveTellNothing) {
  Robot robot(0.0);
  robot.swings_px = 15.0;
  for (int i = 0; i < 100; ++i) robot.Turn(3, i % 2 == 0 ? 0.02 : -0.02);
  EXPECT_EQ(robot.rolls.roll_deg(), std::nullopt);
}

TEST(RollByTurns, OneTurnAloneDecidesNothingHoweverClearItIs) {
  Robot robot(180.0);
  robot.Turn(6, kTurn_rad);
  EXPECT_EQ(robot.rolls.roll_deg(), std::nullopt);
  robot.Turn(8, -kTurn_rad);
  EXPECT_EQ(robot.rolls.roll_deg(), 180.0);
}

TEST(RollByTurns, TurnsThatContradictEachOtherDecideNothing) {
  Robot robot(0.0);
  for (int i = 0; i < 10; ++i) robot.Turn(5, kTurn_rad, i % 2 == 0 ? kTurn_rad : -kTurn_rad);
  EXPECT_EQ(robot.rolls.roll_deg(), std::nullopt);
}

TEST(RollByTurns, ARobotThatStandsAndIsSaidToTurnTellsNothing) {
  Robot robot(0.0);
  robot.ahead = 0.0;
  robot.Turn(100, 0.0, kTurn_rad);
  EXPECT_EQ(robot.rolls.roll_deg(), std::nullopt);
}

TEST(RollByTurns, WhatARobotPassesOnAStraightPathIsNoTurn) {
  Robot robot(0.0);
  robot.aside_px = -2.0;
  robot.Turn(300, 0.0, 0.002);
  EXPECT_EQ(robot.rolls.roll_deg(), std::nullopt);
}

TEST(RollByTurns, AHandfulOfFeaturesAndATurnTooFastToFollowTellNothing) {
  Robot robot(180.0);
  robot.Turn(50, kTurn_rad, kTurn_rad, 7);
  robot.Turn(50, 0.2);
  EXPECT_EQ(robot.rolls.roll_deg(), std::nullopt);
}

// Nothing in the pictures tells these two apart.
TEST(RollByTurns, OdometryThatTakesLeftForRightLooksLikeACameraUpsideDown) {
  Robot robot(0.0);
  robot.Turn(14, kTurn_rad, -kTurn_rad);
  EXPECT_EQ(robot.rolls.roll_deg(), 180.0);
}

}  // namespace
}  // namespace trailcast::teach
