#include "services/console/src/shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "services/base/angles.h"
#include "tests/support/seen_segment.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using std::numbers::pi;
using testing::DoubleNear;
using testing::Each;
using testing::IsEmpty;
using testing::SizeIs;

// Returns a segment of places that look like nothing else.
route::Segment Arc(std::uint32_t index, double length_m, double turn_rad, int features = 30) {
  route::Segment segment = test::SegmentToSee(index + 1, index, features);
  segment.has_odometry = true;
  segment.length_m = length_m;
  segment.heading_change_rad = turn_rad;
  segment.heading_variation_rad = std::abs(turn_rad);
  segment.heading.c = {turn_rad / length_m, 0.0, 0.0};
  segment.duration_s = length_m / 0.5;
  return segment;
}

RouteShape ShapeOf(const std::vector<route::Segment>& segments) {
  ShapeMaker maker(320);
  for (const route::Segment& segment : segments) maker.Add(segment);
  return maker.Shape();
}

TEST(RouteShape, IsDrivenByTheWheels) {
  const RouteShape shape =
      ShapeOf({Arc(0, 2.0, 0.0), Arc(1, pi / 2.0, pi / 2.0), Arc(2, 1.0, 0.0)});
  EXPECT_TRUE(shape.has_odometry);
  EXPECT_EQ(shape.segments, 3U);
  EXPECT_DOUBLE_EQ(shape.length, 3.0 + pi / 2.0);
  const ShapePoint end = shape.points.back();
  EXPECT_DOUBLE_EQ(end.along, shape.length);
  EXPECT_NEAR(end.x_m, 3.0, 0.01);
  EXPECT_NEAR(end.y_m, 2.0, 0.01) << "a quarter of a circle of 1 m to the left, then on";
  EXPECT_FALSE(shape.closing);
}

TEST(RouteShape, TurnsOnTheSpotAndDrivesBackwards) {
  route::Segment back = Arc(1, 1.0, 0.0);
  back.turn_before_rad = pi / 2.0;
  back.reverse = true;
  const ShapePoint end = ShapeOf({Arc(0, 2.0, 0.0), back}).points.back();
  EXPECT_NEAR(end.x_m, 2.0, 0.01);
  EXPECT_NEAR(end.y_m, -1.0, 0.01);
}

TEST(RouteShape, EndsWithTheHeadingThatWasMeasuredAndNotTheFitted) {
  route::Segment bend = Arc(0, 1.0, pi / 2.0);
  bend.heading.c[0] *= 0.9;
  const RouteShape shape = ShapeOf({bend, Arc(1, 1.0, 0.0)});
  const ShapePoint end = shape.points.back();
  EXPECT_NEAR(end.x_m, 2.0 / pi, 0.01);
  EXPECT_NEAR(end.y_m, 2.0 / pi + 1.0, 0.01);
}

TEST(RouteShape, ACellSaysWhatIsSeenAndFeltThere) {
  route::Segment rough = Arc(1, 0.5, 0.0, 10);
  rough.terrain = {.vertical_mps2 = 1.0, .slope_rad = 0.1};
  const RouteShape shape = ShapeOf({Arc(0, 2.0, 0.0), rough});
  ASSERT_THAT(shape.cells, SizeIs(2));
  EXPECT_EQ(shape.cells[0].features, 30U);
  EXPECT_FALSE(shape.cells[0].roughness);
  EXPECT_EQ(shape.cells[1].begin, 2.0);
  EXPECT_EQ(shape.cells[1].end, 2.5);
  EXPECT_EQ(shape.cells[1].features, 10U);
  EXPECT_EQ(shape.cells[1].roughness, route::Roughness::kRough);
  EXPECT_EQ(shape.cells[1].slope_rad, 0.1);
}

TEST(RouteShape, TellsTheGroundAlongAllOfIt) {
  const json unknown = json::parse(ShapeBody({}, ShapeOf({Arc(0, 2.0, 0.0)})))["terrain"];
  EXPECT_EQ(unknown, (json{{"shares", nullptr}, {"up_rad", nullptr}, {"down_rad", nullptr}}));
  route::Segment smooth = Arc(0, 2.0, 0.0);
  smooth.terrain = {.vertical_mps2 = 0.1, .slope_rad = -0.05};
  route::Segment worst = Arc(1, 1.0, 0.0);
  worst.terrain = {.vertical_mps2 = 3.0, .slope_rad = 0.1};
  const json felt =
      json::parse(ShapeBody({}, ShapeOf({smooth, worst, Arc(2, 1.0, 0.0)})))["terrain"];
  EXPECT_EQ(felt["shares"], (json{{"smooth", 0.5}, {"very-rough", 0.25}}));
  EXPECT_EQ(felt["up_rad"], 0.1);
  EXPECT_EQ(felt["down_rad"], 0.05);
}

TEST(RouteShape, ALongRouteIsDrawnInAsManyPartsAsAreSeen) {
  ShapeMaker maker(320);
  constexpr std::uint32_t kSegments = 5000;
  for (std::uint32_t i = 0; i < kSegments; ++i) maker.Add(Arc(i, 2.0, 0.01 * std::sin(i), 2));
  const RouteShape shape = maker.Shape();
  EXPECT_EQ(shape.segments, kSegments);
  EXPECT_EQ(shape.segments_a_cell, 8U);
  EXPECT_THAT(shape.cells, SizeIs(kSegments / 8));
  EXPECT_EQ(shape.cells.front().features, 16U);
  EXPECT_DOUBLE_EQ(shape.cells.back().end, 10'000.0);
  EXPECT_GT(shape.points.size(), ShapeMaker::kMostPoints / 4);
  EXPECT_LE(shape.points.size(), ShapeMaker::kMostPoints + 1);
  EXPECT_NEAR(shape.points.back().along, 10'000.0, 1e-6);
  EXPECT_LT(ShapeBody({}, shape).size(), 150'000U);
}

// A circle of 20 m whose wheels see it a tenth too long on one side, as a real robot's did.
std::vector<route::Segment> Loop() {
  std::vector<route::Segment> loop;
  for (std::uint32_t i = 0; i < 20; ++i) loop.push_back(Arc(i, 1.0, 2.0 * pi / 20.0 * 0.9));
  // Where it ends looks as where it began.
  loop.back().features = loop.front().features;
  return loop;
}

TEST(RouteShape, TheErrorOfALoopIsToldAndSpreadAlongIt) {
  const RouteShape shape = ShapeOf(Loop());
  ASSERT_TRUE(shape.closing);
  EXPECT_GT(shape.closing->gap_m, 1.0);
  EXPECT_NEAR(shape.closing->turn_rad, -0.2 * pi, 1e-9);
  const double radius_m = 20.0 / (2.0 * pi);
  std::vector<double> from_middle_m;
  for (const ShapePoint& point : shape.points) {
    from_middle_m.push_back(std::hypot(point.x_m, point.y_m - radius_m));
  }
  EXPECT_THAT(from_middle_m, Each(DoubleNear(radius_m, 0.05)));
  EXPECT_NEAR(shape.points.back().x_m, 0.0, 1e-9);
  EXPECT_NEAR(shape.points.back().y_m, 0.0, 1e-9);
}

TEST(RouteShape, WhatEndsElsewhereStaysOpen) {
  std::vector<route::Segment> other_end = Loop();
  other_end.back().features = test::SegmentToSee(99, 19).features;
  EXPECT_FALSE(ShapeOf(other_end).closing);
  std::vector<route::Segment> corridor;
  for (std::uint32_t i = 0; i < 20; ++i) corridor.push_back(Arc(i, 1.0, 0.0));
  corridor.back().features = corridor.front().features;
  EXPECT_FALSE(ShapeOf(corridor).closing) << "which looks alike at both ends";
}

TEST(RouteShape, WithoutOdometryItHasTimeAndNoPlan) {
  route::Segment timed = test::SegmentToSee(1, 0);
  timed.duration_s = 3.0;
  const RouteShape shape = ShapeOf({timed, timed});
  EXPECT_FALSE(shape.has_odometry);
  EXPECT_EQ(shape.length, 6.0);
  EXPECT_THAT(shape.points, IsEmpty());
  EXPECT_EQ(json::parse(ShapeBody({}, shape))["unit"], "s");
}

TEST(RouteShape, OfNoSegmentsAndOfAbsurdOnesItIsStillANumber) {
  EXPECT_THAT(ShapeOf({}).points, IsEmpty());
  route::Segment wild = Arc(0, 1e6, 1e300);
  wild.heading.c = {1e308, 1e308, 1e308};
  wild.turn_before_rad = 1e300;
  const RouteShape shape = ShapeOf({wild, Arc(1, 0.0, 0.0), wild});
  for (const ShapePoint& point : shape.points) {
    EXPECT_TRUE(std::isfinite(point.x_m) && std::isfinite(point.y_m)) << point.along;
  }
  EXPECT_THAT(json::parse(ShapeBody({}, shape))["points"]["x_m"],
              Each(testing::Property(&json::is_number, true)));
}

TEST(RouteShape, TheBodyHasItInColumns) {
  const json body = json::parse(ShapeBody({RouteId("ab"), TeachingId(0x1f)}, ShapeOf(Loop())));
  EXPECT_EQ(body["route"], "ab");
  EXPECT_EQ(body["teaching"], "1f");
  EXPECT_EQ(body["unit"], "m");
  EXPECT_EQ(body["length"], 20.0);
  EXPECT_EQ(body["cells"]["begin"][1], 1.0);
  EXPECT_EQ(body["cells"]["features"][1], 30);
  EXPECT_EQ(body["cells"]["roughness"][1], nullptr);
  EXPECT_EQ(body["points"]["along"].size(), body["points"]["y_m"].size());
  EXPECT_EQ(body["closing"]["turn_rad"], -0.628);
}

}  // namespace
}  // namespace trailcast::console
