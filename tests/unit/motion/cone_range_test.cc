#include "services/motion/cone_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace trailcast::motion {
namespace {

using testing::Each;
using testing::IsEmpty;
using testing::SizeIs;
using testing::Truly;

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

ConeRange Sonar(float range_m) { return {0.5, 0.2, 4.0, range_m}; }

TEST(ConeRange, WhatItSeesMayBeAnywhereOnAnArc) {
  const auto points = Points(Sonar(2.0F), {0.3, 0.1, std::numbers::pi / 2.0});
  ASSERT_THAT(points, SizeIs(testing::Ge(20U)));
  const Eigen::Vector2d sensor(0.3, 0.1);
  EXPECT_THAT(points, Each(Truly([&](const Eigen::Vector2d& at) {
                return std::abs((at - sensor).norm() - 2.0) < 1e-6;
              })));
  EXPECT_NEAR(points.front().x() - 0.3, 2.0 * std::sin(0.25), 1e-6) << "it looks to the left";
  EXPECT_NEAR(points.back().x() - 0.3, -2.0 * std::sin(0.25), 1e-6);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LE((points[i] - points[i - 1]).norm(), kArc_m + 1e-6);
  }
}

TEST(ConeRange, ABeamIsAPoint) {
  const auto points = Points({0.0, 0.0, 4.0, 1.0F}, {0.25, 0.0, 0.0});
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_NEAR(points[0].x(), 1.25, 1e-6);
}

TEST(ConeRange, WhatCannotBeMeasuredIsNothing) {
  for (const float range_m : {kNoNumber, kNothing, 0.0F, 0.1F, 4.0F, 5.0F, -1.0F}) {
    EXPECT_THAT(Points(Sonar(range_m), {}), IsEmpty()) << range_m;
  }
  EXPECT_THAT(Points({0.5, 0.0, 4.0, 0.0F}, {}), IsEmpty()) << "a driver's 'nothing'";
}

TEST(ConeRange, WhatIsTooNearToBeMeasuredIsThere) {
  const auto points = Points(Sonar(-kNothing), {});
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(points.front().norm(), 0.2, 1e-6);
  // One that tells only whether something is within its distance.
  EXPECT_THAT(Points({0.0, 0.3, 0.3, -kNothing}, {}), SizeIs(1));
  EXPECT_THAT(Points({0.0, 0.3, 0.3, kNothing}, {}), IsEmpty());
}

TEST(ConeRange, ThatCanBeNoSensorsIsTold) {
  EXPECT_TRUE(Plausible(Sonar(kNoNumber)));
  EXPECT_TRUE(Plausible({0.0, 0.3, 0.3, kNothing}));
  EXPECT_TRUE(Plausible({0.5, 0.0, kNothing, 1.0F}));
  for (const double number : {double{kNoNumber}, double{kNothing}, -0.1}) {
    EXPECT_FALSE(Plausible({number, 0.2, 4.0, 1.0F})) << number;
    EXPECT_FALSE(Plausible({0.5, number, 4.0, 1.0F})) << number;
  }
  EXPECT_FALSE(Plausible({4.0, 0.2, 4.0, 1.0F}));
  EXPECT_FALSE(Plausible({0.5, 0.2, 0.1, 1.0F}));
  EXPECT_FALSE(Plausible({0.5, 0.2, kNoNumber, 1.0F}));
}

}  // namespace
}  // namespace trailcast::motion
