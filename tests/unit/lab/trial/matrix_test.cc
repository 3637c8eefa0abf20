#include "services/lab/trial/matrix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "services/base/angles.h"
#include "tests/unit/lab/trial/trial_rows.h"

namespace trailcast::trial {
namespace {

using Goal = MatrixCell::Goal;
using testing::HasSubstr;

constexpr double kLength_m = 20.0;

// This is a straight path, so that coordinates are metres along it and to its left.
TruePath Straight() {
  TruePath path;
  for (int i = 0; i <= 200; ++i) path.Add({0.1 * i, 0.0});
  return path;
}

MatrixTask Draw(const MatrixCell& cell, std::uint64_t seed) {
  return DrawTask(cell, Straight(), *sim::FindCamera("webcam"), seed);
}

TEST(Matrix, HasTwelveCellsWithNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const MatrixCell& cell : MatrixCells()) names.insert(ToText(cell));
  EXPECT_EQ(names.size(), 12U);
}

TEST(Matrix, BackwardsGoesFromTheEndToTheBeginning) {
  const MatrixTask ahead = Draw({.goal = Goal::kEnd}, 1);
  EXPECT_FALSE(ahead.backwards());
  EXPECT_NEAR(ahead.start.x_m, 0.0, 0.11);
  EXPECT_NEAR(ahead.to_m, kLength_m, 1e-6);
  const MatrixTask back = Draw({.goal = Goal::kBeginning}, 1);
  EXPECT_TRUE(back.backwards());
  EXPECT_NEAR(back.start.x_m, kLength_m, 0.11);
  EXPECT_NEAR(back.start.heading_rad, 0.0, 1e-6) << "it looks along the path in reverse gear, too";
  EXPECT_EQ(back.to_m, 0.0);
}

TEST(Matrix, AnyPointIsFarFromTheStartInEitherDirection) {
  std::set<bool> gears;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const MatrixTask task = Draw({.goal = Goal::kAnyPoint}, seed);
    EXPECT_NEAR(task.start.x_m, task.from_m, 1e-6);
    EXPECT_GE(std::abs(task.to_m - task.from_m), 5.0);
    gears.insert(task.backwards());
  }
  EXPECT_EQ(gears.size(), 2U);
}

TEST(Matrix, BesideThePathARobotIsAsideAndTurned) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const motion::Pose2 start = Draw({.beside = true}, seed).start;
    EXPECT_GE(std::abs(start.y_m), 0.3);
    EXPECT_LE(std::abs(start.y_m), 0.5);
    EXPECT_GE(std::abs(start.heading_rad), Radians(10.0));
    EXPECT_LE(std::abs(start.heading_rad), Radians(20.0));
  }
}

TEST(Matrix, OtherCamerasAreValidAndDifferAndTheSameOneIsKept) {
  std::set<double> widths_deg;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const sim::CameraModel camera = Draw({.other_camera = true}, seed).camera;
    EXPECT_TRUE(sim::Validate(camera));
    EXPECT_GE(camera.horizontal_fov_deg, 80.0);
    EXPECT_LE(camera.horizontal_fov_deg, 140.0);
    EXPECT_GE(camera.height_m, 0.4);
    EXPECT_LE(camera.height_m, 1.7);
    widths_deg.insert(camera.horizontal_fov_deg);
  }
  EXPECT_EQ(widths_deg.size(), 20U);
  EXPECT_EQ(Draw({}, 1).camera.name, "webcam");
}

TEST(Matrix, TheTableTellsWhoGaveUpFromWhoIsWrong) {
  TrialRow reached = test::EndedAt(0.3, 0.0);
  reached.cell = MatrixCell{};
  TrialRow lost = reached;
  lost.arrived = false;
  lost.state = "lost";
  TrialRow wrong = lost;
  wrong.state = "misplaced";
  TrialRow other = reached;
  other.cell->other_camera = true;
  const std::string text = TrialTable({reached, reached, lost, wrong, other});
  EXPECT_THAT(text, HasSubstr("reached    gave up  wrong    median m   max m\n"
                              "on it, to its end, same camera                2/4          1      1"
                              "        0.30    0.30\n"
                              "on it, to its end, other camera               1/1          0      0"
                              "        0.30    0.30\n"));
}

}  // namespace
}  // namespace trailcast::trial
