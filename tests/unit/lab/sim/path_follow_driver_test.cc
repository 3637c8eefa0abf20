#include "services/lab/sim/core/path_follow_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"
#include "services/lab/sim/core/robot.h"
#include "tests/unit/lab/sim/test_worlds.h"

namespace trailcast::sim {
namespace {

struct Drive {
  bool arrived = false;
  double worst_m = 0.0;
  double fastest_mps = 0.0;
  double slowest_in_turn_mps = 9.0;
  double sharpest_radps = 0.0;
  double furthest_x_m = -9.0;
  double fastest_back_mps = 0.0;
  bool forth = true;  // progress never went back
  double progress = 0.0;
  motion::Pose2 end;
};

Drive DriveAlong(const Polyline& points, const motion::Pose2& start, std::uint64_t seed,
                 const DriverOptions& options = {}) {
  DifferentialDriveRobot robot(test::SmallWorld().Build(), {},
                               DrawRobot(Disturbances::ForScout(), seed), start, 1.0, seed);
  PathFollowDriver driver(points, options);
  Drive drive;
  for (int step = 0; step < 30 * 120 && !driver.arrived(); ++step) {
    const motion::VelocityCommand command = driver.Command(robot.true_pose());
    robot.Drive(command, 1.0 / 30.0);
    drive.forth = drive.forth && driver.progress() >= drive.progress;
    drive.progress = driver.progress();
    const double off_m = Nearest(driver.path(), motion::Position(robot.true_pose())).distance_m;
    drive.worst_m = std::max(drive.worst_m, off_m);
    drive.furthest_x_m = std::max(drive.furthest_x_m, robot.true_pose().x_m);
    drive.fastest_mps = std::max(drive.fastest_mps, command.linear_mps);
    drive.fastest_back_mps = std::max(drive.fastest_back_mps, -command.linear_mps);
    drive.sharpest_radps = std::max(drive.sharpest_radps, std::abs(command.angular_radps));
    if (std::abs(command.angular_radps) > 0.25) {
      drive.slowest_in_turn_mps = std::min(drive.slowest_in_turn_mps, command.linear_mps);
    }
  }
  drive.arrived = driver.arrived();
  drive.end = robot.true_pose();
  return drive;
}

class DriverOnCorners : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(DriverOnCorners, StaysWithinFiveCentimetresAndStopsAtTheEnd) {
  const Polyline points = {{-5, -3}, {0, -3}, {0, 1}, {3, 3}, {6, 3}};
  const Drive drive = DriveAlong(points, StartPose(points), GetParam());
  EXPECT_TRUE(drive.arrived);
  EXPECT_LT(drive.worst_m, 0.05);
  EXPECT_LT(std::hypot(drive.end.x_m - 6.0, drive.end.y_m - 3.0), 0.05);
  EXPECT_NEAR(drive.fastest_mps, 0.4, 0.01);
  EXPECT_LT(drive.slowest_in_turn_mps, 0.3);
  EXPECT_LE(drive.sharpest_radps, 0.44);
}

INSTANTIATE_TEST_SUITE_P(Robots, DriverOnCorners, ::testing::Values(1, 2, 3, 4));

TEST(PathFollowDriver, TurnsOnTheSpotFirstWhenItFacesAway) {
  const Polyline points = {{0, 0}, {3, 0}};
  const Drive drive = DriveAlong(points, {0.0, 0.0, Radians(150.0)}, 1);
  EXPECT_TRUE(drive.arrived);
  EXPECT_LT(drive.worst_m, 0.05);
}

TEST(PathFollowDriver, TurnsOnTheSpotWhereThePathDoublesBack) {
  const Polyline points = {{-3, 0}, {2, 0}, {-3, 0}, {-3, 3}};
  const Drive drive = DriveAlong(points, StartPose(points), 1);
  EXPECT_TRUE(drive.arrived);
  EXPECT_LT(drive.worst_m, 0.06);
  EXPECT_GT(drive.furthest_x_m, 1.95);
  EXPECT_TRUE(drive.forth) << "on the way back, too";
  EXPECT_GT(drive.progress, 0.99);
  EXPECT_LT(std::hypot(drive.end.x_m + 3.0, drive.end.y_m - 3.0), 0.05);
}

TEST(PathFollowDriver, GoesOnTheOtherWayWhereThePathDoublesBack) {
  const DrivenPath path{{{2, 0}, {-1, 0}, {-2, 2}, {-2, 3}, {-2, -1}}, {}, Gear::kBackwards};
  const Drive drive =
      DriveAlong(path.points, StartPose(path), 1, {.shunts_from = path.shunts_from});
  EXPECT_TRUE(drive.arrived);
  EXPECT_LT(drive.worst_m, 0.06);
  EXPECT_NEAR(drive.fastest_back_mps, 0.4, 0.01);
  EXPECT_NEAR(drive.fastest_mps, 0.4, 0.01);
  EXPECT_LT(std::hypot(drive.end.x_m + 2.0, drive.end.y_m + 1.0), 0.05);
  EXPECT_NEAR(drive.end.heading_rad, Radians(-90.0), 0.1);
}

TEST(PathFollowDriver, ArrivedAsksForNothing) {
  PathFollowDriver driver({{0, 0}, {1, 0}});
  EXPECT_FALSE(driver.arrived());
  EXPECT_EQ(driver.Command({1.0, 0.0, 0.0}), motion::VelocityCommand{});
  EXPECT_TRUE(driver.arrived());
}

}  // namespace
}  // namespace trailcast::sim
