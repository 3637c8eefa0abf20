#include "services/lab/trial/matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"
#include "services/lab/sim/core/path.h"
#include "services/lab/sim/core/random.h"

namespace trailcast::trial {
namespace {

using Goal = MatrixCell::Goal;

constexpr double kAbout_m = 0.1;
// A drawn goal is at least this share of the path away.
constexpr double kFarAway = 0.25;
// A flat picture of a wider view is stretched beyond use, so such lenses are fisheyes.
constexpr double kWidestPinhole_deg = 100.0;

sim::CameraModel DrawCamera(std::uint64_t seed) {
  sim::Random random(seed, "matrix camera");
  sim::CameraModel camera;
  camera.name = "drawn";
  camera.horizontal_fov_deg = random.Uniform(80.0, 140.0);
  camera.height_m = random.Uniform(0.4, 1.7);
  if (camera.horizontal_fov_deg > kWidestPinhole_deg) camera.model = sim::LensModel::kFisheye;
  return camera;
}

double WithSign(double amount, sim::Random& random) {
  return random.Uniform() < 0.5 ? -amount : amount;
}

motion::Pose2 DrawBeside(sim::Random& random) {
  const double left_m = WithSign(random.Uniform(0.3, 0.5), random);
  return {0.0, left_m, WithSign(Radians(random.Uniform(10.0, 20.0)), random)};
}

}  // namespace

std::vector<MatrixCell> MatrixCells() {
  std::vector<MatrixCell> cells;
  for (const bool other_camera : {false, true}) {
    for (const Goal goal : {Goal::kEnd, Goal::kBeginning, Goal::kAnyPoint}) {
      for (const bool beside : {false, true}) cells.push_back({beside, goal, other_camera});
    }
  }
  return cells;
}

std::string ToText(const MatrixCell& cell) {
  const char* const goal = cell.goal == Goal::kEnd         ? "to its end"
                           : cell.goal == Goal::kBeginning ? "backwards"
                                                           : "to any point";
  return fmt::format("{}, {}, {} camera", cell.beside ? "beside" : "on it", goal,
                     cell.other_camera ? "other" : "same");
}

int NumberOf(const MatrixCell& cell) {
  const auto cells = MatrixCells();
  return static_cast<int>(std::find(cells.begin(), cells.end(), cell) - cells.begin()) + 1;
}

MatrixTask DrawTask(const MatrixCell& cell, const TruePath& taught, const sim::CameraModel& camera,
                    std::uint64_t seed) {
  const double length_m = taught.length_m();
  MatrixTask task;
  task.camera = cell.other_camera ? DrawCamera(seed) : camera;
  sim::Random random(seed, "matrix");
  switch (cell.goal) {
    case Goal::kEnd:
      task.to_m = length_m;
      break;
    case Goal::kBeginning:
      task.from_m = length_m;
      break;
    case Goal::kAnyPoint:
      do {
        task.from_m = random.Uniform(0.0, length_m);
        task.to_m = random.Uniform(0.0, length_m);
      } while (std::abs(task.to_m - task.from_m) < kFarAway * length_m);
      break;
  }
  task.start = sim::PoseAlong(taught.points_m(), task.from_m, kAbout_m);
  if (cell.beside) task.start = motion::Compose(task.start, DrawBeside(random));
  return task;
}

}  // namespace trailcast::trial
