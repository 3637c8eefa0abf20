#include "services/lab/sim/core/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/lab/sim/core/judge.h"
#include "services/lab/sim/core/simulated_robot.h"
#include "services/lab/sim/looks/pedestrian.h"
#include "tests/unit/lab/sim/test_worlds.h"

namespace trailcast::sim {
namespace {

using test::SmallWorld;

std::shared_ptr<const ActorShape> Person() {
  static const auto person = *MakePedestrian(7);
  return person;
}

// Stands at a place, looking back at the origin, as long as it is asked for.
Actor Standing(double x_m, double y_m, double from_s = 0.0) {
  Timetable table(from_s, {x_m, y_m, std::atan2(-y_m, -x_m)});
  table.Stand(100.0);
  return {Person(), table, std::nullopt};
}

SimulatedRobotOptions Options(Actors actors) {
  SimulatedRobotOptions options;
  options.camera = *FindCamera("webcam");
  options.disturbances = Disturbances::None();
  options.actors = std::move(actors);
  return options;
}

// For minutes of driving in which nobody looks at the pictures.
SimulatedRobotOptions DriveOptions(Actors actors) {
  SimulatedRobotOptions options = Options(std::move(actors));
  options.camera.width = 32;
  options.camera.height = 24;
  return options;
}

// Mean grey difference of two pictures over columns [from, to).
double Difference(const image::GrayImage& a, const image::GrayImage& b, int from, int to) {
  double sum = 0.0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = from; x < to; ++x) {
      const auto i = image::PixelIndex(x, y, a.width);
      sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
    }
  }
  return sum / (a.height * (to - from));
}

TEST(Stage, APersonIsSeenWhereItStandsAndNowhereElse) {
  const auto world = SmallWorld().Build();
  const auto alone = *SimulatedRobot::Create(world, Options({}));
  const auto met = *SimulatedRobot::Create(world, Options({Standing(3.0, 0.0)}));
  const image::GrayImage empty = alone->Step({}).image;
  const image::GrayImage seen = met->Step({}).image;
  EXPECT_GT(Difference(empty, seen, 150, 170), 20.0);
  EXPECT_EQ(Difference(empty, seen, 0, 80), 0.0);
  EXPECT_EQ(Difference(empty, seen, 240, 320), 0.0);
}

TEST(Stage, OtherRobotsInTheSameWorldDoNotSeeIt) {
  const auto world = SmallWorld().Build();
  const auto before = *SimulatedRobot::Create(world, Options({}));
  const auto met = *SimulatedRobot::Create(world, Options({Standing(3.0, 0.0)}));
  const auto after = *SimulatedRobot::Create(world, Options({}));
  const image::GrayImage first = before->Step({}).image;
  (void)met->Step({});
  EXPECT_EQ(first.pixels, after->Step({}).image.pixels);
}

TEST(Stage, SomebodyWhoHasNotComeYetIsNotSeen) {
  const auto world = SmallWorld().Build();
  const auto robot = *SimulatedRobot::Create(world, Options({Standing(3.0, 0.0, 0.1)}));
  const image::GrayImage empty = robot->Step({}).image;
  EXPECT_TRUE(Judge(*robot).stage().parts().empty());
  for (int step = 0; step < 4; ++step) (void)robot->Step({});
  EXPECT_FALSE(Judge(*robot).stage().parts().empty());
  EXPECT_GT(Difference(empty, robot->Step({}).image, 150, 170), 20.0);
}

TEST(Stage, APersonsShadowFallsOnTheGroundAwayFromTheSun) {
  const auto world = SmallWorld().Sun({0, 1, 1}).Build();
  CameraRenderer renderer(world, *FindCamera("webcam"));
  Stage stage(world, {Standing(4.0, 0.0)});
  stage.Advance(1.0, {});
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 0.5;
  pose.linear() = BodyFromCamera(0.0, 0.0);
  const std::vector<float> with = renderer.Render(pose, stage.parts()).gray;
  const std::vector<float> without = renderer.Render(pose).gray;
  const auto darker_at = [&](const Eigen::Vector3d& place) {
    const Eigen::Vector2d pixel = *renderer.lens().Project(pose.inverse() * place);
    const auto i = image::PixelIndex(static_cast<int>(std::lround(pixel.x())),
                                     static_cast<int>(std::lround(pixel.y())), 320);
    return without[i] - with[i];
  };
  EXPECT_GT(darker_at({4.0, -1.2, 0.0}), 10.0F);  // of the chest, 1.2 m high
  EXPECT_EQ(darker_at({4.0, 1.2, 0.0}), 0.0F);
}

TEST(Stage, APersonHoldsTheRobotAsAWallDoesAndTheJudgeCanTell) {
  const auto robot =
      *SimulatedRobot::Create(SmallWorld().Build(), DriveOptions({Standing(1.0, 0.0)}));
  Observation seen;
  for (int step = 0; step < 150; ++step) seen = robot->Step({0.4, 0.0});
  EXPECT_TRUE(seen.blocked);
  EXPECT_TRUE(Judge(*robot).blocked_by_actor());
  EXPECT_LT(Judge(*robot).true_pose().x_m, 0.85);
  EXPECT_GT(seen.odometry.x_m, 1.5);  // the wheels turned all the same
}

TEST(Stage, AWallIsNotAnActor) {
  const auto world = SmallWorld().WhiteBox({1, -1, 0}, {1.2F, 1, 1}).Build();
  const auto robot = *SimulatedRobot::Create(world, DriveOptions({Standing(5.0, 3.0)}));
  for (int step = 0; step < 150; ++step) (void)robot->Step({0.4, 0.0});
  EXPECT_TRUE(Judge(*robot).blocked());
  EXPECT_FALSE(Judge(*robot).blocked_by_actor());
}

TEST(Stage, SomebodyStepsInWhenTheRobotComesAndLetsItGoAfterTenSeconds) {
  Encounter encounter;
  encounter.place = {3.0, 0.0};
  const auto robot = *SimulatedRobot::Create(
      SmallWorld().Build(), DriveOptions({Actor{Person(), std::nullopt, encounter}}));
  const Judge judge(*robot);
  double seen_first_at_m = 0.0;
  double held_s = 0.0;
  for (int step = 0; step < 30 * 30; ++step) {
    (void)robot->Step({0.4, 0.0});
    if (seen_first_at_m == 0.0 && !judge.stage().parts().empty()) {
      seen_first_at_m = judge.true_pose().x_m;
    }
    if (judge.blocked_by_actor()) held_s += 1.0 / 30.0;
  }
  EXPECT_NEAR(seen_first_at_m, 3.0 - 0.8 - 0.4, 0.25);
  EXPECT_GT(held_s, 7.0);
  EXPECT_LT(held_s, 11.0);
  EXPECT_GT(judge.true_pose().x_m, 4.0);  // and on
}

TEST(Stage, WalkingLegsSwingToAndFroAndStandingOnesDoNot) {
  Timetable table(0.0, {2.0, -2.0, 1.5708});
  table.GoTo({2.0, 2.0}, 1.4).Stand(2.0);
  Stage stage(SmallWorld().Build(), {Actor{Person(), table, std::nullopt}});
  const auto leg_tilt = [&](double time_s) {
    stage.Advance(time_s, {});
    return std::abs(stage.parts()[1].world_from_part.linear()(2, 0));
  };
  float most = 0.0F;
  for (double time_s = 0.1; time_s < 2.5; time_s += 0.1) most = std::max(most, leg_tilt(time_s));
  EXPECT_GT(most, 0.3F);
  EXPECT_NEAR(leg_tilt(4.0), 0.0F, 1e-6F);
}

}  // namespace
}  // namespace trailcast::sim
