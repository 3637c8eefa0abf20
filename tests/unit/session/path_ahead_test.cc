#include "agent/session/src/place/path_ahead.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trailcast::agent {
namespace {

// Straight on for a metre, then along a bend to the left with a radius of 2 m, then straight on.
KnownRoute Bend(double turn_before_last_rad = 0.0) {
  KnownRoute route(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    route::Segment segment;
    segment.index = SegmentIndex(i);
    segment.has_odometry = true;
    segment.length_m = 1.0;
    if (i == 1) segment.heading.c = {0.5, 0.0, 0.0};
    if (i == 2) segment.turn_before_rad = turn_before_last_rad;
    route.Add(std::move(segment));
  }
  return route;
}

TEST(PathAhead, GoesOnThroughSegments) {
  const auto path = PathAheadOf(Bend(), SegmentIndex(0), 0.2, 2.5);
  ASSERT_EQ(path.size(), 26U);
  EXPECT_NEAR((path[8] - Eigen::Vector2d(0.8, 0.0)).norm(), 0.0, 1e-9);
  // A metre of the bend on.
  const Eigen::Vector2d bent(0.8 + 2.0 * std::sin(0.5), 2.0 - 2.0 * std::cos(0.5));
  EXPECT_NEAR((path[18] - bent).norm(), 0.0, 0.002);
  const Eigen::Vector2d on = path[25] - path[18];
  EXPECT_NEAR(std::atan2(on.y(), on.x()), 0.5, 0.01);
}

TEST(PathAhead, BeginsAlongThePathWhereTheRobotIs) {
  const auto path = PathAheadOf(Bend(), SegmentIndex(1), 0.5, 0.2);
  ASSERT_EQ(path.size(), 3U);
  EXPECT_NEAR(path[1].y(), 0.0, 0.004);
  EXPECT_GT(path[2].y(), path[1].y());
}

TEST(PathAhead, EndsWhereTheRobotStands) {
  EXPECT_EQ(PathAheadOf(Bend(), SegmentIndex(2), 0.57, 3.0).size(), 5U);
  EXPECT_EQ(PathAheadOf(Bend(1.0), SegmentIndex(1), 0.57, 3.0).size(), 5U)
      << "before it turns on the spot";
}

TEST(PathAhead, ASegmentsStartMayStillBeAhead) {
  const auto path = PathAheadOf(Bend(), SegmentIndex(1), -0.2, 0.4);
  ASSERT_EQ(path.size(), 5U);
  EXPECT_NEAR(path[2].y(), 0.0, 1e-9);
  EXPECT_GT(path[4].y(), 0.0);
}

TEST(PathBehind, IsThePlaceNextToTheRobotOnTheWayThatLeadsToTheSegment) {
  // Half-way round the bend, 0.3 m to its left, as seen from where it ends: back along x.
  const double half = 0.25;
  const Eigen::Vector2d there(-2.0 * std::sin(half), 2.0 - 2.0 * std::cos(half));
  const Eigen::Vector2d left(std::sin(half), std::cos(half));
  const auto behind = NearestBehind(Bend(), SegmentIndex(2), there + 0.3 * left, 4.0);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->segment, SegmentIndex(1));
  EXPECT_NEAR(behind->along_m, 0.5, 0.011);
  EXPECT_NEAR(behind->pose.heading_rad, -half, 0.006);
  EXPECT_NEAR(behind->pose.x_m, there.x(), 0.011);
  EXPECT_NEAR(behind->pose.y_m, there.y(), 0.011);
}

TEST(PathBehind, GoesBackThroughTurnsOnTheSpot) {
  const auto behind = NearestBehind(Bend(1.0), SegmentIndex(2), {-0.1, 0.1}, 4.0);
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->pose.heading_rad, -1.0, 0.1);
  EXPECT_GT(behind->pose.y_m, 0.03) << "the bend comes from the left";
}

TEST(PathBehind, EndsWhereTheRouteBeginsAndWhereTheWayIsTooLong) {
  EXPECT_FALSE(NearestBehind(Bend(), SegmentIndex(0), {-0.5, 0.0}, 4.0));
  const auto first = NearestBehind(Bend(), SegmentIndex(1), {-3.0, 0.0}, 4.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->segment, SegmentIndex(0));
  EXPECT_NEAR(first->along_m, 0.0, 1e-9);
  EXPECT_NEAR(NearestBehind(Bend(), SegmentIndex(1), {-3.0, 0.0}, 0.5)->along_m, 0.5, 0.03);
}

}  // namespace
}  // namespace trailcast::agent
