#include "services/replay/roll.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "services/base/angles.h"

namespace trailcast::replay {
namespace {

// Features that are magnified, shifted and rolled between the stored and the current image.
std::vector<ImagePair> Rolled(double roll_rad, int count, int mismatched) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  std::vector<ImagePair> pairs;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d stored(uniform(-150, 150), uniform(-110, 110));
    const Eigen::Vector2d current =
        Eigen::Rotation2Dd(-roll_rad) * (0.9 * stored + Eigen::Vector2d(6.0, -2.0));
    pairs.push_back({current, stored});
  }
  for (int i = 0; i < mismatched; ++i) {
    pairs[static_cast<std::size_t>(i)].current_px = {uniform(-150, 150), uniform(-110, 110)};
  }
  return pairs;
}

TEST(Roll, KnownRotationIsRecovered) {
  for (const double degrees : {-8.0, -3.0, 0.0, 2.0, 5.0}) {
    const Roll roll = EstimateRoll(Rolled(Radians(degrees), 40, 0));
    EXPECT_NEAR(Degrees(roll.angle_rad), degrees, 0.05);
    EXPECT_EQ(roll.inliers, 40);
  }
}

TEST(Roll, MismatchesDoNotMoveIt) {
  const Roll roll = EstimateRoll(Rolled(Radians(4.0), 40, 14));
  EXPECT_NEAR(Degrees(roll.angle_rad), 4.0, 0.2);
  EXPECT_GE(roll.inliers, 24);
}

TEST(Roll, UnrollUndoesIt) {
  const std::vector<ImagePair> pairs = Rolled(Radians(5.0), 20, 0);
  const double angle_rad = EstimateRoll(pairs).angle_rad;
  for (const ImagePair& pair : pairs) {
    const Eigen::Vector2d upright = Unroll(pair.current_px, angle_rad);
    EXPECT_LT((upright - (0.9 * pair.stored_px + Eigen::Vector2d(6.0, -2.0))).norm(), 0.5);
  }
}

TEST(Roll, TooFewOrContradictingFeaturesGiveNone) {
  EXPECT_EQ(EstimateRoll({}).inliers, 0);
  EXPECT_EQ(EstimateRoll(Rolled(0.05, 2, 0)).angle_rad, 0.0);
  EXPECT_EQ(EstimateRoll(Rolled(0.05, 30, 30)).angle_rad, 0.0);
}

}  // namespace
}  // namespace trailcast::replay
