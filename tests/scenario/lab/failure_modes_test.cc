// Where the paper says that its method fails (end of section IV): the robot goes on all the same,
// or says that it cannot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/image/canvas.h"
#include "services/lab/sim/core/scene_builder.h"
#include "tests/scenario/lab/taught_run.h"

namespace trailcast::trial {
namespace {

// How far the robot stands from a point, along and across the path's first leg.
Eigen::Vector2d From(const motion::Pose2& pose, const sim::Polyline& path, double along_m) {
  const motion::Pose2 start = sim::StartPose(path);
  const Eigen::Vector2d ahead(std::cos(start.heading_rad), std::sin(start.heading_rad));
  const Eigen::Vector2d off = motion::Position(pose) - sim::PointAlong(path, along_m);
  return {off.dot(ahead), ahead.x() * off.y() - ahead.y() * off.x()};
}

// Carried past a milestone, so that it is never seen and no wheel says how far that was.
TEST(FailureMode, AMissedTransitionIsMadeUpForWithoutAnybodysHelp) {
  const sim::Place place = test::Open("indoor");
  const sim::CameraModel camera = *sim::FindCamera("webcam");
  const Taught taught = test::TeachIn(place, 6.0, camera, 11);
  for (const double missed_m : {0.6, 1.2}) {
    bool carried = false;
    const test::Ending ending = test::FollowIn(
        place, camera, taught, 21, [&](sim::Judge& truth, const agent::ReplayStep& step) {
          if (carried || step.segment.value() != 1 || step.fraction < 0.7) return;
          truth.Shove({missed_m, 0.0, 0.0});
          carried = true;
        });
    EXPECT_TRUE(carried);
    EXPECT_EQ(ending.last.state, agent::ReplayState::kArrived) << ending.last.reason;
    const Eigen::Vector2d off = From(ending.pose, place.path.points, 6.0);
    EXPECT_LT(std::abs(off.x()), 0.3) << missed_m;
    EXPECT_LT(std::abs(off.y()), 0.15) << missed_m;
  }
}

// Somebody pushes it aside: no wheel feels that, and most features outdoors are far enough away to
// stay where they were in the picture. It takes its time: of ten that were shoved by 3 m in trials,
// two were back within 0.2 m after ten metres, and all within 0.14 m after thirty.
TEST(FailureMode, ShovedOffThePathItFindsOutAndComesBack) {
  const sim::Place place = test::Open("paved");
  const sim::CameraModel camera = *sim::FindCamera("webcam");
  const Taught taught = test::TeachIn(place, 24.0, camera, 11);
  double least_left_m = 0.0;
  bool shoved = false;
  bool found_out = false;
  const test::Ending ending = test::FollowIn(
      place, camera, taught, 21, [&](sim::Judge& truth, const agent::ReplayStep& step) {
        const Eigen::Vector2d at = From(truth.true_pose(), place.path.points, 0.0);
        if (!shoved && at.x() > 4.0) {
          truth.Shove({0.0, -3.0, 0.0});
          shoved = true;
        }
        least_left_m = std::min(least_left_m, at.y());
        found_out = found_out || step.decision.carried_left_m.value_or(0.0) < 0.0;
      });
  EXPECT_LT(least_left_m, -2.5);
  EXPECT_TRUE(found_out);
  EXPECT_EQ(ending.last.state, agent::ReplayState::kArrived) << ending.last.reason;
  EXPECT_LT(taught.path.DistanceTo(motion::Position(ending.pose)), 0.2);
}

// A gallery whose walls are one and the same window, a metre wide, over and over again.
sim::Place Gallery() {
  image::Canvas window(128, 256, {190, 185, 175});
  window.FillBox({14.0, 30.0}, {114.0, 190.0}, {90, 95, 110});
  window.FillBox({22.0, 38.0}, {60.0, 110.0}, {215, 225, 235});
  window.FillBox({68.0, 38.0}, {106.0, 110.0}, {160, 180, 205});
  window.FillBox({22.0, 118.0}, {60.0, 182.0}, {150, 165, 185});
  window.FillBox({68.0, 118.0}, {106.0, 182.0}, {200, 215, 225});
  window.FillBox({30.0, 205.0}, {98.0, 235.0}, {70, 60, 50});
  sim::SceneBuilder builder;
  const auto wall = builder.AddMaterial("wall", {255, 255, 255},
                                        std::make_shared<sim::Texture>(window.picture()));
  const auto floor = builder.AddMaterial("floor", {110, 105, 100});
  constexpr float kFrom_m = -2.0F;
  constexpr float kTo_m = 14.0F;
  constexpr float kHalfWidth_m = 1.2F;
  builder.Panel(floor, {kFrom_m, kHalfWidth_m, 0}, {kTo_m - kFrom_m, 0, 0},
                {0, -2 * kHalfWidth_m, 0});
  for (float x = kFrom_m; x < kTo_m; x += 1.0F) {
    builder.Panel(wall, {x, kHalfWidth_m, 2}, {1, 0, 0}, {0, 0, -2});
    builder.Panel(wall, {x + 1.0F, -kHalfWidth_m, 2}, {-1, 0, 0}, {0, 0, -2});
  }
  for (float y = kHalfWidth_m; y > -kHalfWidth_m; y -= 0.8F) {
    builder.Panel(wall, {kTo_m, y, 2}, {0, -0.8F, 0}, {0, 0, -2});
  }
  auto world = sim::World::Build(builder.Take("gallery"));
  EXPECT_TRUE(world);
  return {*world, {{{0.0, 0.0}, {7.0, 0.0}}, std::nullopt}};
}

TEST(FailureMode, ARepeatedPatternDoesNotPassForTheNextOrTheLastOfItsKind) {
  const sim::Place place = Gallery();
  const sim::CameraModel camera = *sim::FindCamera("webcam");
  const Taught taught = test::TeachIn(place, 7.0, camera, 11);
  for (const std::uint64_t seed : {21ULL, 22ULL}) {
    const test::Ending ending = test::FollowIn(place, camera, taught, seed);
    EXPECT_EQ(ending.last.state, agent::ReplayState::kArrived) << ending.last.reason;
    const Eigen::Vector2d off = From(ending.pose, place.path.points, 7.0);
    EXPECT_LT(std::abs(off.x()), 0.3) << seed;
    EXPECT_LT(std::abs(off.y()), 0.1) << seed;
  }
}

// In the middle of a field everything is 60 m away: that tells where to head, not where one is.
TEST(FailureMode, ARobotThatSeesOnlyDistantFeaturesIsNeverSureOfItsPlace) {
  const sim::Place place = test::Open("field");
  const sim::CameraModel camera = *sim::FindCamera("webcam");
  const Taught taught = test::TeachIn(place, 12.0, camera, 11);
  int distant = 0;
  int sure = 0;
  double widest_when_sure_m = 0.0;
  double fastest_mps = 0.0;
  const test::Ending ending = test::FollowIn(
      place, camera, taught, 21, [&](sim::Judge& truth, const agent::ReplayStep& step) {
        if (step.trust == agent::Trust::kDistant) {
          ++distant;
          fastest_mps = std::max(fastest_mps, step.command.linear_mps);
          EXPECT_NE(step.reason.find("only distant features"), std::string::npos);
          return;
        }
        ++sure;
        const Eigen::Vector2d off = From(truth.true_pose(), place.path.points, 0.0);
        widest_when_sure_m = std::max(widest_when_sure_m, std::abs(off.y()));
      });
  EXPECT_GT(distant, 3 * sure);
  EXPECT_LT(widest_when_sure_m, 0.25);
  EXPECT_LT(fastest_mps, 0.3);  // taught at 0.4
  EXPECT_EQ(ending.last.state, agent::ReplayState::kArrived) << ending.last.reason;
}

}  // namespace
}  // namespace trailcast::trial
