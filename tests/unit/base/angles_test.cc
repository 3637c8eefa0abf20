#include "services/base/angles.h"

#include <gtest/gtest.h>

#include "services/base/time.h"

namespace trailcast {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Angles, DegreesAndRadians) {
  EXPECT_DOUBLE_EQ(Radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(Degrees(-kPi / 4), -45.0);
}

TEST(WrapAngle, LeavesWhatLiesWithinHalfATurn) {
  for (const double angle : {-3.0, -0.1, 0.0, 0.1, 3.0, kPi}) {
    EXPECT_DOUBLE_EQ(WrapAngle(angle), angle);
  }
}

TEST(WrapAngle, TakesWholeTurnsAway) {
  EXPECT_NEAR(WrapAngle(Radians(190)), Radians(-170), 1e-12);
  EXPECT_NEAR(WrapAngle(Radians(-190)), Radians(170), 1e-12);
  EXPECT_NEAR(WrapAngle(Radians(3600 + 45)), Radians(45), 1e-12);
}

TEST(WrapAngle, HalfATurnIsPositiveFromEitherSide) {
  EXPECT_DOUBLE_EQ(WrapAngle(-kPi), kPi);
  EXPECT_DOUBLE_EQ(WrapAngle(kPi), kPi);
}

TEST(Time, SecondsAndBack) {
  EXPECT_EQ(FromSeconds(1.5), std::chrono::milliseconds(1500));
  EXPECT_DOUBLE_EQ(Seconds(std::chrono::milliseconds(-250)), -0.25);
}

}  // namespace
}  // namespace trailcast
