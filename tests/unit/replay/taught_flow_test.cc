#include "services/replay/taught_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/taught_segment.h"

namespace trailcast::replay {
namespace {

std::vector<InverseDepth> Depths(const route::Segment& segment) {
  TaughtFlow flow(320);
  flow.Learn(segment);
  return flow.Depths(segment);
}

TEST(TaughtFlow, TellsTheLandmarksDepthOnAStraight) {
  const test::LandmarkScene scene({{4.0, 1.0, 0.3}, {8.0, -2.0, 0.5}});
  const auto run = test::TeachArcs(scene, {}, {{1.5, 0.0}});
  ASSERT_EQ(run.segment.features.size(), 2U);
  const auto depths = Depths(run.segment);
  EXPECT_NEAR(depths[0].at_start_per_m, 1.0 / 4.0, 0.01);
  EXPECT_NEAR(depths[1].at_start_per_m, 1.0 / 8.0, 0.01);
}

TEST(TaughtFlow, TellsNearFromFarInABend) {
  const test::LandmarkScene scene({{5.0, 1.2, 0.3}, {40.0, 3.0, 6.0}, {5.0, -0.4, 0.9}});
  const auto run = test::TeachArcs(scene, {}, {{1.2, 0.25}});
  ASSERT_EQ(run.segment.features.size(), 3U);
  const auto depths = Depths(run.segment);
  EXPECT_NEAR(depths[0].at_start_per_m, 0.2, 0.05);
  EXPECT_LT(depths[1].at_start_per_m, 0.07);
}

TEST(TaughtFlow, IsUnsureNearTheImageCentre) {
  const test::LandmarkScene scene({{6.0, 0.05, 0.02}, {6.0, 1.5, 0.5}});
  const auto run = test::TeachArcs(scene, {}, {{1.5, 0.0}});
  const auto depths = Depths(run.segment);
  EXPECT_GT(depths[0].sigma_per_m, 5 * depths[1].sigma_per_m);
}

TEST(DrawTogether, MakesOneDistanceOfDepthsThatOnlyNoiseTellsApart) {
  std::vector<InverseDepth> depths = {
      {0.008, 0.005}, {0.016, 0.005}, {0.012, 0.004}, {0.010, 0.004}, {0.1, 0.2}};
  DrawTogether(depths);
  for (const InverseDepth& depth : depths) {
    EXPECT_NEAR(depth.at_start_per_m, 0.0114, 0.001);
    EXPECT_NEAR(depth.sigma_per_m, 0.0022, 0.0005);  // of the mean
  }
}

TEST(DrawTogether, LeavesNearAndFarWhereTheyAre) {
  std::vector<InverseDepth> depths = {
      {0.02, 0.005}, {0.25, 0.005}, {0.5, 0.005}, {0.1, 0.005}, {0.3, 0.3}};
  DrawTogether(depths);
  EXPECT_NEAR(depths[0].at_start_per_m, 0.02, 0.002);
  EXPECT_NEAR(depths[1].at_start_per_m, 0.25, 0.002);
  EXPECT_NEAR(depths[2].at_start_per_m, 0.5, 0.002);
  EXPECT_NEAR(depths[0].sigma_per_m, 0.005, 0.0005);
  EXPECT_LT(depths[4].sigma_per_m, 0.25);  // that it is one of these is something known of it
}

TEST(DrawTogether, LeavesAFewAlone) {
  std::vector<InverseDepth> few = {{0.01, 0.1}, {0.2, 0.1}};
  DrawTogether(few);
  EXPECT_EQ(few[0].at_start_per_m, 0.01);
  EXPECT_EQ(few[1].sigma_per_m, 0.1);
}

// Returns what a route of segments, each of these arcs, teaches of a camera.
TaughtFlow LearnOn(const std::vector<std::vector<test::Arc>>& segments, const test::ScoutEye& eye) {
  const test::LandmarkScene scene = test::LandmarkScene::Corridor(3.0, 20.0, 300, 7);
  TaughtFlow flow(320);
  motion::Pose2 pose;
  for (const std::vector<test::Arc>& arcs : segments) {
    const auto run = test::TeachArcs(scene, pose, arcs, eye);
    flow.Learn(run.segment);
    pose = run.end;
  }
  return flow;
}

TaughtFlow LearnOnBends(const test::ScoutEye& eye) {
  return LearnOn(
      {{{1.0, 0.0}}, {{1.0, 0.25}}, {{1.0, -0.25}}, {{1.0, -0.25}}, {{1.0, 0.25}}, {{1.0, 0.0}}},
      eye);
}

TEST(TaughtFlow, LearnsTheFocalLengthFromBends) {
  EXPECT_NEAR(LearnOnBends({.focal_px = 280.0}).camera().focal_px, 280.0, 14.0);
  EXPECT_NEAR(LearnOnBends({.focal_px = 200.0}).camera().focal_px, 200.0, 10.0);
  EXPECT_NEAR(LearnOnBends({.focal_px = 420.0}).camera().focal_px, 420.0, 25.0);
}

// No polynomial follows a corner in the middle of a segment.
TEST(TaughtFlow, LearnsTheFocalLengthFromCorners) {
  for (const double focal_px : {200.0, 280.0, 420.0}) {
    std::vector<std::vector<test::Arc>> segments;
    for (const double turn_rad : {0.2, -0.2, -0.2, 0.2}) {
      segments.push_back({{0.2, 0.0}, {0.05, turn_rad}, {1.0, 0.0}});
      segments.push_back({{0.8, 0.0}, {0.05, -turn_rad}, {0.4, 0.0}});
    }
    const TaughtFlow flow = LearnOn(segments, {.focal_px = focal_px});
    EXPECT_NEAR(flow.focal().px, focal_px, 0.06 * focal_px);
    EXPECT_LT(flow.focal().sigma, 0.08);
  }
}

// A camera that rolls and pitches moves all that it sees; it tells less of itself, and knows it.
TEST(TaughtFlow, IsNotSureOfAFocalLengthThatRoughGroundHides) {
  for (const double phase : {0.0, 1.0, 2.0, 3.0}) {
    const auto tilt = [phase](const motion::Pose2& pose) {
      return test::Tilt{.roll_rad = 0.05 * std::sin(7.0 * pose.x_m + phase),
                        .pitch_rad = 0.04 * std::sin(11.0 * pose.x_m + 2.0 * phase)};
    };
    const replay::FocalLength focal = LearnOnBends({.focal_px = 280.0, .tilt = tilt}).focal();
    EXPECT_LT(std::abs(std::log(focal.px / 280.0)), 2.0 * focal.sigma) << focal.px;
  }
}

TEST(TaughtFlow, LearnsWhereACrookedCameraIsGoing) {
  // A camera that looks 3 degrees to the left goes to the right of its image centre.
  const ScoutCamera camera = LearnOnBends({.yaw_rad = 0.0524}).camera();
  EXPECT_NEAR(camera.ahead_u_px, 280.0 * 0.0524, 0.3 * 280.0 * 0.0524);
  EXPECT_NEAR(camera.ahead_v_px, 0.0, 2.0);
}

// Odometry says that the robot swung to one side and back while it drove straight on.
TEST(TaughtFlow, IsNotLedAstrayByAFalseHeading) {
  const test::LandmarkScene scene = test::LandmarkScene::Corridor(3.0, 20.0, 60, 7);
  const auto run = test::TeachArcs(scene, {}, {{1.5, 0.0}});
  const auto before = Depths(run.segment);
  route::Segment swung = run.segment;
  swung.heading.c = {0.05, -0.033, 0.0};
  TaughtFlow flow(320);
  const double focal_px = flow.camera().focal_px;
  flow.Learn(swung);
  EXPECT_NEAR(flow.camera().focal_px, focal_px, 0.1 * focal_px);
  const auto depths = flow.Depths(swung);
  ASSERT_EQ(depths.size(), before.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    EXPECT_NEAR(depths[i].at_start_per_m, before[i].at_start_per_m,
                0.04 + 3.0 * depths[i].sigma_per_m);
  }
}

TEST(TaughtFlow, ASegmentWithoutFeaturesTeachesNothing) {
  TaughtFlow flow(320);
  const double before_px = flow.camera().focal_px;
  route::Segment empty;
  empty.length_m = 1.0;
  flow.Learn(empty);
  EXPECT_TRUE(flow.Depths(empty).empty());
  EXPECT_DOUBLE_EQ(flow.camera().focal_px, before_px);
}

}  // namespace
}  // namespace trailcast::replay
