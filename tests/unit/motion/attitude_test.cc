#include "services/motion/attitude.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trailcast::motion {
namespace {

constexpr double kQuarter_rad = std::numbers::pi / 2;
const double kHalf = std::sqrt(0.5);

TEST(Heading, IsWhereTheNosePointsSeenFromAbove) {
  EXPECT_NEAR(*Heading({0.0, 0.0, 0.0, 1.0}), 0.0, 1e-12);
  EXPECT_NEAR(*Heading({0.0, 0.0, kHalf, kHalf}), kQuarter_rad, 1e-12);
  EXPECT_NEAR(*Heading({0.0, 0.0, -kHalf, kHalf}), -kQuarter_rad, 1e-12);
  EXPECT_NEAR(*Heading({0.0, 0.0, 3.0, 3.0}), kQuarter_rad, 1e-12) << "of any length";
}

TEST(Heading, OfARobotOnASlopeIsTheSame) {
  // To the left, nose up by 30 degrees.
  const double up_rad = -std::numbers::pi / 12;
  EXPECT_NEAR(*Heading({-kHalf * std::sin(up_rad), kHalf * std::sin(up_rad),
                        kHalf * std::cos(up_rad), kHalf * std::cos(up_rad)}),
              kQuarter_rad, 1e-9);
}

TEST(Heading, IsNothingForNumbersThatAreNone) {
  EXPECT_FALSE(Heading({0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(Heading({0.0, 0.0, std::nan(""), 1.0}));
}

}  // namespace
}  // namespace trailcast::motion
