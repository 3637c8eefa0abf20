#include "services/lab/sim/core/robot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "services/base/angles.h"
#include "tests/unit/lab/sim/test_worlds.h"

namespace trailcast::sim {
namespace {

using test::SmallWorld;
constexpr double kPeriod_s = 1.0 / 30.0;

void DriveFor(DifferentialDriveRobot& robot, const motion::VelocityCommand& command,
              double duration_s) {
  for (int i = 0; i < std::lround(duration_s / kPeriod_s); ++i) robot.Drive(command, kPeriod_s);
}

double Sigma(const std::vector<double>& values) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(values.size());
  return std::sqrt(squares / count - sum * sum / count / count);
}

TEST(Robot, AsDrawnItsOdometryIsItsMotion) {
  DifferentialDriveRobot robot(SmallWorld().Build(), {}, RobotErrors{}, {1.0, 2.0, 0.5}, 1.0, 1);
  DriveFor(robot, {0.5, 0.3}, 4.0);
  const motion::Pose2 moved = motion::Between({1.0, 2.0, 0.5}, robot.true_pose());
  EXPECT_NEAR(moved.x_m, robot.odometry().x_m, 1e-9);
  EXPECT_NEAR(moved.y_m, robot.odometry().y_m, 1e-9);
  EXPECT_NEAR(moved.heading_rad, robot.odometry().heading_rad, 1e-9);
  EXPECT_NEAR(moved.heading_rad, 0.3 * 4.0, 0.15);  // less what speeding up takes
}

TEST(Robot, WheelsNeedTimeToReachTheirSpeed) {
  DifferentialDriveRobot robot(SmallWorld().Build(), {}, RobotErrors{}, {}, 1.0, 1);
  robot.Drive({0.5, 0.0}, kPeriod_s);
  EXPECT_NEAR(robot.true_velocity().linear_mps, 1.2 / 30.0, 1e-6);
  DriveFor(robot, {0.5, 0.0}, 1.0);
  EXPECT_NEAR(robot.true_velocity().linear_mps, 0.5, 1e-6);
}

TEST(Robot, IsShakenByRoughGroundWhereItIsAndNowhereElse) {
  DifferentialDriveRobot robot(SmallWorld().Ground(GroundMode::kFlat).Build(), {}, RobotErrors{},
                               {}, 1.0, 1);
  robot.SetRough({{{2.0, 0.0}, 1.0, 0.02}});
  std::vector<double> before_m;
  std::vector<double> there_m;
  for (int i = 0; i < 150; ++i) {
    robot.Drive({0.5, 0.0}, kPeriod_s);
    const double x_m = robot.true_pose().x_m;
    const double z_m = robot.WorldFromBody().translation().z();
    if (x_m < 0.8) before_m.push_back(z_m);
    if (x_m > 1.3 && x_m < 2.0) there_m.push_back(z_m);
  }
  ASSERT_GT(there_m.size(), 30U);
  EXPECT_EQ(Sigma(before_m), 0.0);
  EXPECT_GT(Sigma(there_m), 0.003);
}

// Ten metres straight by odometry, then one turn on the spot, by two hundred robots.
TEST(Robot, OdometryErrorsAreAsLargeAsAskedFor) {
  const auto world = SmallWorld().Ground(GroundMode::kFlat).Build();
  Disturbances disturbances = Disturbances::ForScout();
  disturbances.slip = 0.0;
  std::vector<double> scale;
  std::vector<double> bias;
  std::vector<double> turn;
  for (auto* values : {&scale, &bias, &turn}) values->reserve(200);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    DifferentialDriveRobot robot(world, {}, DrawRobot(disturbances, seed), {}, 1.0, seed);
    DriveFor(robot, {0.9, 0.0}, 10.0);
    const double driven_m = robot.odometry().x_m;
    scale.push_back(std::hypot(robot.true_pose().x_m, robot.true_pose().y_m) / driven_m);
    bias.push_back(Degrees(robot.true_pose().heading_rad) / driven_m);
    DifferentialDriveRobot turning(world, {}, DrawRobot(disturbances, seed), {}, 1.0, seed);
    DriveFor(turning, {0.0, 1.0}, 2.0);
    turn.push_back(turning.true_pose().heading_rad / turning.odometry().heading_rad);
  }
  EXPECT_NEAR(Sigma(scale), 0.01, 0.002);
  EXPECT_NEAR(Sigma(bias), 0.3, 0.06);
  EXPECT_NEAR(Sigma(turn), 0.0141, 0.003);  // scale and wheel base together
}

TEST(Robot, SlipDiffersFromStepToStepAndSeedToSeed) {
  const auto world = SmallWorld().Build();
  RobotErrors slipping;
  slipping.slip = 0.05;
  DifferentialDriveRobot first(world, {}, slipping, {}, 1.0, 1);
  DifferentialDriveRobot again(world, {}, slipping, {}, 1.0, 1);
  DifferentialDriveRobot other(world, {}, slipping, {}, 1.0, 2);
  for (auto* robot : {&first, &again, &other}) DriveFor(*robot, {0.5, 0.0}, 8.0);
  EXPECT_EQ(first.true_pose().y_m, again.true_pose().y_m);
  EXPECT_NE(first.true_pose().y_m, other.true_pose().y_m);
  EXPECT_NE(first.true_pose().heading_rad, 0.0);
  EXPECT_EQ(first.odometry().heading_rad, 0.0);
}

TEST(Robot, WallStopsItWhileItsWheelsTurn) {
  const auto world = SmallWorld().WhiteBox({2, -3, 0}, {2.2F, 3, 2}).Build();
  DifferentialDriveRobot robot(world, {}, RobotErrors{}, {}, 1.0, 1);
  DriveFor(robot, {0.5, 0.0}, 8.0);
  EXPECT_TRUE(robot.blocked());
  EXPECT_NEAR(robot.true_pose().x_m, 1.8, 0.03);
  EXPECT_GT(robot.odometry().x_m, 3.0);
  DriveFor(robot, {-0.5, 0.0}, 2.0);
  EXPECT_FALSE(robot.blocked());
  EXPECT_LT(robot.true_pose().x_m, 1.5);
}

TEST(Robot, SlopeIsClimbedAndTiltsIt) {
  const auto world = SmallWorld().Slope(0.08F).Build();
  DifferentialDriveRobot robot(world, {}, RobotErrors{}, {}, 1.0, 1);
  DriveFor(robot, {0.5, 0.0}, 8.0);
  EXPECT_FALSE(robot.blocked());
  const Eigen::Isometry3d pose = robot.WorldFromBody();
  EXPECT_NEAR(pose.translation().z(), 0.08 * (robot.true_pose().x_m - 1.0), 0.01);
  const Eigen::Vector3d ahead = pose.linear() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.z(), std::sin(std::atan(0.08)), 0.003);
}

TEST(Robot, AcrossASlopeItRolls) {
  const auto world = SmallWorld().Slope(0.08F).Build();
  DifferentialDriveRobot robot(world, {}, RobotErrors{}, {4.0, 0.0, Radians(90.0)}, 2.0, 1);
  const Eigen::Vector3d left = robot.WorldFromBody().linear() * Eigen::Vector3d::UnitY();
  EXPECT_NEAR(left.z(), -std::sin(std::atan(0.08)), 0.003);
}

TEST(Robot, CommandsBeyondTheWheelsKeepTheTurn) {
  DifferentialDriveRobot robot(SmallWorld().Build(), {}, RobotErrors{}, {}, 1.0, 1);
  DriveFor(robot, {5.0, 1.0}, 2.0);
  EXPECT_NEAR(robot.true_velocity().angular_radps, 1.0, 1e-6);
  EXPECT_LE(robot.true_velocity().linear_mps, 1.0);
}

}  // namespace
}  // namespace trailcast::sim
