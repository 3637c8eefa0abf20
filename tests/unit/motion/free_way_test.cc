#include "services/motion/free_way.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trailcast::motion {
namespace {

using Eigen::Vector2d;

const Outline kBody{0.3, 0.25};
const VelocityCommand kAhead{0.4, 0.0};
const VelocityCommand kLeft{0.4, 0.4};  // about a point 1 m to the left

std::optional<double> Way(const Vector2d& at, const VelocityCommand& command) {
  const auto met = FirstMet({at}, kBody, command);
  return met ? std::optional(met->way_m) : std::nullopt;
}

TEST(FreeWay, StraightAheadItIsFreeUpToItsFront) {
  EXPECT_NEAR(Way({1.0, 0.2}, kAhead).value(), 0.7, 1e-9);
  EXPECT_NEAR(Way({0.1, 0.0}, kAhead).value(), 0.0, 1e-9);
  EXPECT_FALSE(Way({1.0, 0.3}, kAhead)) << "beside its way";
  EXPECT_FALSE(Way({-0.5, 0.0}, kAhead)) << "behind it";
}

TEST(FreeWay, TheFirstOfManyCounts) {
  const auto met = FirstMet({{2.0, 0.0}, {1.0, -0.1}, {0.5, 3.0}}, kBody, kAhead);
  ASSERT_TRUE(met);
  EXPECT_EQ(met->at, Vector2d(1.0, -0.1));
}

TEST(FreeWay, InABendWhatIsOnTheArcCounts) {
  // A quarter of the circle on: its front is there a little before its axle.
  EXPECT_NEAR(Way({1.0, 1.0}, kLeft).value(), std::numbers::pi / 2.0 - std::asin(0.3), 1e-9);
  EXPECT_NEAR(Way({1.0, -1.0}, {0.4, -0.4}).value(), std::numbers::pi / 2.0 - std::asin(0.3), 1e-9);
  EXPECT_FALSE(Way({1.5, 0.0}, kLeft)) << "straight ahead, where it does not go";
  EXPECT_TRUE(Way({1.5, 0.0}, kAhead));
  EXPECT_FALSE(Way({0.0, 1.0}, kLeft)) << "what it goes round";
  EXPECT_FALSE(Way({-0.3, 0.0}, kLeft));
}

TEST(FreeWay, InABendTheOuterCornerSwingsOut) {
  EXPECT_TRUE(Way({0.4, -0.2}, kLeft));
  EXPECT_FALSE(Way({0.1, -0.27}, kLeft)) << "beside it: the corner is past that";
  EXPECT_NEAR(Way({0.1, -0.2}, kLeft).value(), 0.0, 1e-9);
}

TEST(FreeWay, AWideBendIsNearlyStraight) {
  EXPECT_NEAR(Way({1.0, 0.0}, {0.4, 0.4 / 999.0}).value(), Way({1.0, 0.0}, kAhead).value(), 1e-3);
}

TEST(FreeWay, InReverseWhatIsBehindCounts) {
  EXPECT_NEAR(Way({-1.0, 0.0}, {-0.4, 0.0}).value(), 0.75, 1e-9);
  EXPECT_FALSE(Way({1.0, 0.0}, {-0.4, 0.0}));
  EXPECT_TRUE(Way({-1.0, 1.0}, {-0.4, -0.4})) << "backwards about the same point on the left";
  EXPECT_FALSE(Way({-1.0, -1.0}, {-0.4, -0.4}));
}

TEST(FreeWay, OnTheSpotWhatIsWithinTheSweptCircleCounts) {
  const VelocityCommand turn{0.0, 0.5};
  for (const Vector2d& at : {Vector2d(0.38, 0.0), Vector2d(0.0, -0.38), Vector2d(-0.38, 0.0)}) {
    EXPECT_NEAR(Way(at, turn).value(), 0.0, 1e-9);
    EXPECT_FALSE(Way(1.05 * at, turn));
  }
}

TEST(FreeWay, WhoStandsMeetsNothing) { EXPECT_FALSE(Way({0.1, 0.0}, {})); }

TEST(FreeWay, PaceIsThatOfItsFastestPart) {
  EXPECT_DOUBLE_EQ(Pace(kBody, kAhead), 0.4);
  EXPECT_DOUBLE_EQ(Pace(kBody, {-0.1, -1.0}), 0.25);
}

}  // namespace
}  // namespace trailcast::motion
