#include "services/motion/steady_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trailcast::motion {
namespace {

using Eigen::Vector2d;
using testing::IsEmpty;
using testing::SizeIs;

constexpr float kUnseen = std::numeric_limits<float>::infinity();
constexpr double kDegree = std::numbers::pi / 180.0;

// All round, a degree a range, from straight ahead, with a wall so far away.
Scan Room(float wall_m = 5.0F) {
  return {0.0, kDegree, 0.1, 10.0, std::vector<float>(360, wall_m)};
}
Scan With(Scan scan, std::size_t index, float range_m) {
  scan.ranges_m[index] = range_m;
  return scan;
}
std::size_t Nearer(const std::vector<Vector2d>& points, double range_m) {
  return static_cast<std::size_t>(std::count_if(
      points.begin(), points.end(), [&](const Vector2d& at) { return at.norm() < range_m; }));
}

TEST(SteadyPoints, AreWhatIsSeenFromTheAxle) {
  const double quarter = std::numbers::pi / 2.0;
  const auto points = SteadyPoints().Next({-quarter, quarter, 0.1, 10.0, {3.0F, 3.1F, 3.2F}}, 0.2);
  ASSERT_THAT(points, SizeIs(3));
  EXPECT_NEAR((points[0] - Vector2d(0.2, -3.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((points[1] - Vector2d(3.3, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((points[2] - Vector2d(0.2, 3.2)).norm(), 0.0, 1e-6);
}

TEST(SteadyPoints, ASingleReturnInOneScanIsNothing) {
  for (const float wall_m : {5.0F, kUnseen}) {
    SteadyPoints steady;
    EXPECT_EQ(Nearer(steady.Next(Room(wall_m), 0.0), 4.0), 0U);
    EXPECT_EQ(Nearer(steady.Next(With(Room(wall_m), 40, 0.6F), 0.0), 4.0), 0U);
    EXPECT_EQ(Nearer(steady.Next(Room(wall_m), 0.0), 4.0), 0U);
    // Dust is elsewhere the next time.
    EXPECT_EQ(Nearer(steady.Next(With(Room(wall_m), 40, 0.6F), 0.0), 4.0), 0U);
    EXPECT_EQ(Nearer(steady.Next(With(Room(wall_m), 55, 0.6F), 0.0), 4.0), 0U);
    EXPECT_EQ(Nearer(steady.Next(With(Room(wall_m), 55, 1.2F), 0.0), 4.0), 0U);
  }
}

TEST(SteadyPoints, AThinPoleThatIsSeenAgainIsSomething) {
  SteadyPoints steady;
  (void)steady.Next(With(Room(), 40, 0.60F), 0.0);
  EXPECT_EQ(Nearer(steady.Next(With(Room(), 40, 0.58F), 0.0), 4.0), 1U);
  EXPECT_EQ(Nearer(steady.Next(With(Room(), 43, 0.54F), 0.0), 4.0), 1U) << "the robot turns";
  EXPECT_EQ(Nearer(steady.Next(Room(), 0.0), 4.0), 0U);
}

TEST(SteadyPoints, APoleAheadIsSeenAcrossTheEndOfATurn) {
  SteadyPoints steady;
  (void)steady.Next(With(Room(), 359, 0.6F), 0.0);
  EXPECT_EQ(Nearer(steady.Next(With(Room(), 1, 0.6F), 0.0), 4.0), 1U);
}

TEST(SteadyPoints, TwoReturnsBesideEachOtherAreSomethingAtOnce) {
  EXPECT_EQ(Nearer(SteadyPoints().Next(With(With(Room(), 40, 0.6F), 41, 0.7F), 0.0), 4.0), 2U);
}

TEST(SteadyPoints, AScannerOfOneRangeIsBelieved) {
  EXPECT_THAT(SteadyPoints().Next({0.0, 0.1, 0.1, 10.0, {0.6F}}, 0.0), SizeIs(1));
  EXPECT_THAT(SteadyPoints().Next({0.0, 0.1, 0.1, 10.0, {kUnseen}}, 0.0), IsEmpty());
}

// A driver that was started anew may have other angles.
TEST(SteadyPoints, WhatAnotherScannerSawSaysNothing) {
  SteadyPoints steady;
  (void)steady.Next({6.0, 1e-300, 0.1, 10.0, {0.6F}}, 0.0);
  EXPECT_EQ(Nearer(steady.Next(With(Room(), 40, 0.6F), 0.0), 4.0), 0U);
}

}  // namespace
}  // namespace trailcast::motion
