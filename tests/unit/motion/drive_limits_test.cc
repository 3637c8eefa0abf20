#include "services/motion/drive_limits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trailcast::motion {
namespace {

constexpr double kLong_s = 100.0;  // for any acceleration

double Curvature(const VelocityCommand& command) {
  return command.angular_radps / command.linear_mps;
}

TEST(Shape, LeavesWhatIsWithinTheLimits) {
  const VelocityCommand wanted{0.4, -0.3};
  EXPECT_EQ(Shape(wanted, wanted, 0.033, {}), wanted);
  EXPECT_EQ(Shape({}, wanted, 0.033, {}), VelocityCommand{});
}

TEST(Shape, ReducesSpeedAndTurnTogether) {
  const VelocityCommand wanted{0.8, 0.6};
  DriveLimits limits;
  limits.speed_mps = 0.2;
  const VelocityCommand slow = Shape(wanted, {}, kLong_s, limits);
  EXPECT_DOUBLE_EQ(slow.linear_mps, 0.2);
  EXPECT_DOUBLE_EQ(Curvature(slow), Curvature(wanted));
  limits = {};
  limits.turn_rate_radps = 0.3;
  const VelocityCommand gentle = Shape(wanted, {}, kLong_s, limits);
  EXPECT_DOUBLE_EQ(gentle.angular_radps, 0.3);
  EXPECT_DOUBLE_EQ(Curvature(gentle), Curvature(wanted));
}

TEST(Shape, SpeedsUpFromStandingWithinTheAccelerationAndKeepsTheCurvature) {
  DriveLimits limits;
  limits.acceleration_mps2 = 0.5;
  const VelocityCommand wanted{0.4, 0.2};
  VelocityCommand now;
  for (int i = 1; i <= 8; ++i) {
    now = Shape(wanted, now, 0.1, limits);
    EXPECT_NEAR(now.linear_mps, std::min(0.4, 0.05 * i), 1e-12);
    EXPECT_DOUBLE_EQ(Curvature(now), Curvature(wanted));
  }
}

TEST(Shape, SlowsDownAtOnceAndGoesTheOtherWayFromStanding) {
  const VelocityCommand fast{0.8, 0.0};
  EXPECT_DOUBLE_EQ(Shape({0.1, 0.0}, fast, 0.01, {}).linear_mps, 0.1);
  EXPECT_DOUBLE_EQ(Shape({-0.8, 0.0}, fast, 0.1, {}).linear_mps, -0.1);
}

TEST(Shape, ATurnOnTheSpotSpeedsUpToo) {
  DriveLimits limits;
  limits.acceleration_mps2 = 0.4;
  EXPECT_DOUBLE_EQ(Shape({0.0, 1.0}, {}, 0.1, limits).angular_radps, 0.2);
  EXPECT_DOUBLE_EQ(Shape({0.0, 1.0}, {0.0, 0.2}, 0.1, limits).angular_radps, 0.4);
}

TEST(Shape, ACarTurnsNoTighterThanItsSteeringAndNotOnTheSpot) {
  DriveLimits limits;
  limits.turn_radius_m = 0.5;
  EXPECT_DOUBLE_EQ(Shape({0.2, -0.8}, {}, kLong_s, limits).angular_radps, -0.4);
  EXPECT_EQ(Shape({0.0, 0.8}, {}, kLong_s, limits), VelocityCommand{});
  EXPECT_EQ(Shape({0.4, 0.2}, {}, kLong_s, limits), (VelocityCommand{0.4, 0.2}));
}

}  // namespace
}  // namespace trailcast::motion
