#include "services/lab/sim/core/simulated_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/lab/sim/core/judge.h"
#include "tests/unit/lab/sim/test_worlds.h"

namespace trailcast::sim {
namespace {

using test::SmallWorld;
using ::testing::HasSubstr;

std::shared_ptr<const World> Place() {
  return SmallWorld()
      .WhiteBox({3, 0.3F, 0}, {3.4F, 0.8F, 1})
      .WhiteBox({5, -1, 0}, {5.3F, -0.4F, 0.7F})
      .Sun({1, 1, 2})
      .Build();
}

SimulatedRobotOptions Options(std::uint64_t seed) {
  SimulatedRobotOptions options;
  options.camera = *FindCamera("webcam");
  options.seed = seed;
  return options;
}

TEST(SimulatedRobot, SameSeedGivesTheSameObservationsBitForBit) {
  const auto first = *SimulatedRobot::Create(Place(), Options(4));
  const auto again = *SimulatedRobot::Create(Place(), Options(4));
  const auto other = *SimulatedRobot::Create(Place(), Options(5));
  bool others_differ = false;
  for (int step = 0; step < 20; ++step) {
    const motion::VelocityCommand command{0.3, 0.2 * std::sin(step)};
    const Observation a = first->Step(command);
    const Observation b = again->Step(command);
    const Observation c = other->Step(command);
    ASSERT_EQ(a.image.pixels, b.image.pixels) << step;
    ASSERT_EQ(a.odometry.x_m, b.odometry.x_m);
    ASSERT_EQ(a.stamp, b.stamp);
    others_differ = others_differ || a.image.pixels != c.image.pixels;
  }
  EXPECT_TRUE(others_differ);
  EXPECT_EQ(Judge(*first).true_pose().x_m, Judge(*again).true_pose().x_m);
}

// Grey levels by which two pictures differ, on average.
double Difference(const image::GrayImage& a, const image::GrayImage& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
  return sum / static_cast<double>(a.pixels.size());
}

double Brightness(const image::GrayImage& picture) {
  double sum = 0.0;
  for (const std::uint8_t pixel : picture.pixels) sum += pixel;
  return sum / static_cast<double>(picture.pixels.size());
}

TEST(SimulatedRobot, ACameraThatHangsUpsideDownSeesTheSameTurned) {
  SimulatedRobotOptions options = Options(4);
  options.disturbances = Disturbances::None();
  const image::GrayImage upright = (*SimulatedRobot::Create(Place(), options))->Step({}).image;
  options.camera.roll_deg = 180.0;
  image::GrayImage turned = (*SimulatedRobot::Create(Place(), options))->Step({}).image;
  EXPECT_GT(Difference(upright, turned), 10.0);
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  EXPECT_LT(Difference(upright, turned), 4.0);
}

TEST(SimulatedRobot, ACameraAheadSeesWhatARobotSeesThatIsAhead) {
  SimulatedRobotOptions options = Options(4);
  options.disturbances = Disturbances::None();
  const auto look = [&options] {
    return (*SimulatedRobot::Create(Place(), options))->Step({}).image;
  };
  const image::GrayImage behind = look();
  options.camera.ahead_m = 0.4;
  const image::GrayImage seen = look();
  options.camera.ahead_m = 0.0;
  options.start.x_m += 0.4;
  EXPECT_LT(Difference(seen, look()), 0.5);
  EXPECT_GT(Difference(seen, behind), 2.0);
}

TEST(SimulatedRobot, AKnockTurnsTheCameraFromThenOn) {
  SimulatedRobotOptions options = Options(4);
  options.disturbances = Disturbances::None();
  options.camera.knock_yaw_deg = 5.0;
  options.camera.knock_at_s = 0.15;
  const auto robot = *SimulatedRobot::Create(Place(), options);
  std::vector<image::GrayImage> seen;
  for (int i = 0; i < 7; ++i) seen.push_back(robot->Step({}).image);
  EXPECT_LT(Difference(seen[0], seen[4]), 4.0);
  EXPECT_GT(Difference(seen[4], seen[5]), 5.0);
  EXPECT_LT(Difference(seen[5], seen[6]), 4.0);
}

TEST(SimulatedRobot, ExposureSwingsWithinItsPeriod) {
  SimulatedRobotOptions options = Options(4);
  options.disturbances = Disturbances::None();
  options.camera.exposure_swing = 1.5;
  options.camera.exposure_period_s = 0.4;
  const auto robot = *SimulatedRobot::Create(Place(), options);
  std::vector<double> levels;
  for (int i = 0; i < 13; ++i) levels.push_back(Brightness(robot->Step({}).image));
  EXPECT_NEAR(levels[3] / levels[0], 1.5, 0.2);
  EXPECT_NEAR(levels[9] / levels[0], 1.0 / 1.5, 0.1);
  EXPECT_NEAR(levels[12] / levels[0], 1.0, 0.05);
}

TEST(SimulatedRobot, ClockRunsAtThirtyHertzFromZero) {
  const auto robot = *SimulatedRobot::Create(Place(), Options(1));
  EXPECT_EQ(robot->Step({}).stamp, SensorTime(0));
  EXPECT_NEAR(Seconds(robot->Step({}).stamp), 1.0 / 30.0, 1e-6);
}

TEST(SimulatedRobot, ScoutStartsWhereToldAFollowerAboutThere) {
  SimulatedRobotOptions options = Options(3);
  options.start = {1.0, 0.5, 0.2};
  options.disturbances = Disturbances::ForScout();
  const auto scout = *SimulatedRobot::Create(Place(), options);
  EXPECT_EQ(Judge(*scout).true_pose().x_m, 1.0);
  EXPECT_EQ(Judge(*scout).true_pose().heading_rad, 0.2);
  double largest_m = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    options.seed = seed;
    options.disturbances = Disturbances();
    const auto follower = *SimulatedRobot::Create(Place(), options);
    const auto& pose = Judge(*follower).true_pose();
    largest_m = std::max(largest_m, std::hypot(pose.x_m - 1.0, pose.y_m - 0.5));
  }
  EXPECT_GT(largest_m, 0.05);
  EXPECT_LT(largest_m, 0.6);
}

TEST(SimulatedRobot, ExposureOfFollowersStaysWithinItsRange) {
  double lowest = 9.0;
  double highest = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double gain = DrawRobot(Disturbances(), seed).gain;
    lowest = std::min(lowest, gain);
    highest = std::max(highest, gain);
  }
  EXPECT_GE(lowest, 0.7);
  EXPECT_LT(lowest, 0.75);
  EXPECT_LE(highest, 1.4);
  EXPECT_GT(highest, 1.3);
  EXPECT_EQ(DrawRobot(Disturbances::ForScout(), 1).gain, 1.0);
}

TEST(SimulatedRobot, TheSameRobotMayStartTwice) {
  const RobotErrors first = DrawRobot(Disturbances(), 1, 2);
  const RobotErrors again = DrawRobot(Disturbances(), 1, 3);
  EXPECT_EQ(first.camera_yaw_rad, again.camera_yaw_rad);
  EXPECT_EQ(first.camera_height_m, again.camera_height_m);
  EXPECT_EQ(first.odometry_scale, again.odometry_scale);
  EXPECT_EQ(first.heading_bias_rad_per_m, again.heading_bias_rad_per_m);
  EXPECT_NE(first.start_left_m, again.start_left_m);
  EXPECT_NE(first.camera_yaw_rad, DrawRobot(Disturbances(), 2).camera_yaw_rad);
}

TEST(SimulatedRobot, ShoveMovesItWithoutItsOdometryNoticing) {
  const auto robot = *SimulatedRobot::Create(Place(), Options(1));
  const motion::Pose2 before = robot->Step({}).odometry;
  Judge judge(*robot);
  const motion::Pose2 from = judge.true_pose();
  judge.Shove({0.0, 1.0, 0.0});
  const motion::Pose2 moved = motion::Between(from, judge.true_pose());
  EXPECT_NEAR(moved.y_m, 1.0, 1e-9);
  const motion::Pose2 after = robot->Step({}).odometry;
  EXPECT_EQ(before.x_m, after.x_m);
  EXPECT_EQ(before.y_m, after.y_m);
}

TEST(SimulatedRobot, BumperTellsOfAWall) {
  SimulatedRobotOptions options = Options(1);
  options.start = {2.6, 0.55, 0.0};
  options.disturbances = Disturbances::None();
  const auto robot = *SimulatedRobot::Create(Place(), options);
  bool blocked = false;
  for (int step = 0; step < 40; ++step) blocked = robot->Step({0.5, 0.0}).blocked;
  EXPECT_TRUE(blocked);
}

TEST(SimulatedRobot, StartWithoutGroundIsRefusedWithTheWorldsExtent) {
  SimulatedRobotOptions options = Options(1);
  options.start = {50.0, 0.0, 0.0};
  options.disturbances = Disturbances::ForScout();
  const auto robot = SimulatedRobot::Create(Place(), options);
  ASSERT_FALSE(robot);
  EXPECT_THAT(robot.error().message, HasSubstr("50.00"));
  EXPECT_THAT(robot.error().message, HasSubstr("10.00"));
}

TEST(SimulatedRobot, ImpossibleCameraOrRateIsRefused) {
  SimulatedRobotOptions options = Options(1);
  options.camera.width = 3;
  EXPECT_FALSE(SimulatedRobot::Create(Place(), options));
  options = Options(1);
  options.rate_hz = 0.0;
  EXPECT_FALSE(SimulatedRobot::Create(Place(), options));
}

TEST(SimulatedRobot, SunOfItsOwnChangesThePicture) {
  const auto world = Place();
  SimulatedRobotOptions options = Options(1);
  const auto morning = *SimulatedRobot::Create(world, options);
  options.lighting = world->lighting();
  options.lighting->toward_sun = Eigen::Vector3f(1, -1, 1).normalized();
  const auto evening = *SimulatedRobot::Create(world, options);
  EXPECT_NE(morning->Step({}).image.pixels, evening->Step({}).image.pixels);
}

TEST(MovedSun, IsElsewhereAsBrightAndStillUp) {
  const Lighting noon;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Lighting later = WithMovedSun(noon, seed);
    EXPECT_NEAR(later.toward_sun.norm(), 1.0F, 1e-5F);
    EXPECT_GT(later.toward_sun.z(), 0.25F);
    EXPECT_LT(later.toward_sun.dot(noon.toward_sun), 0.999F);
    EXPECT_EQ(later.sun, noon.sun);
    EXPECT_EQ(later.toward_sun, WithMovedSun(noon, seed).toward_sun);
  }
}

}  // namespace
}  // namespace trailcast::sim
