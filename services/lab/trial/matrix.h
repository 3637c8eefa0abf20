#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/lab/sim/core/camera.h"
#include "services/lab/trial/path_judge.h"
#include "services/motion/motion.h"

// The matrix of `trailcast trial --matrix`: robots that begin on the taught path or beside it, that
// are to go forwards, backwards or to any point of it, and that have the scout's camera or another
// one. Learned methods are compared in such a matrix (LoTIS, Robotics: Science and Systems 2026).
namespace trailcast::trial {

struct MatrixCell {
  enum class Goal : std::uint8_t {
    kEnd,        // from the path's beginning to its end
    kBeginning,  // from its end to its beginning, in reverse gear
    kAnyPoint,   // from a drawn place to another one, whichever way; it is told neither gear nor
                 // place
  };
  bool beside = false;  // it begins beside the path, and does not look along it
  Goal goal = Goal::kEnd;
  bool other_camera = false;

  auto operator<=>(const MatrixCell&) const = default;
};

// A goal is reached within this distance.
inline constexpr double kReached_m = 0.5;

// Returns all twelve, in the order of the table.
[[nodiscard]] std::vector<MatrixCell> MatrixCells();
// Returns "beside, backwards, other camera".
[[nodiscard]] std::string ToText(const MatrixCell& cell);
// Returns its number in the table, from 1.
[[nodiscard]] int NumberOf(const MatrixCell& cell);

// This is what a robot is set, drawn from a seed.
struct MatrixTask {
  motion::Pose2 start;
  double from_m = 0.0;  // of the taught path
  double to_m = 0.0;
  sim::CameraModel camera;

  [[nodiscard]] bool backwards() const { return to_m < from_m; }
};
// The robot has `camera` unless the cell is of other cameras. Other cameras have 80 to 140 degrees
// and hang 0.4 to 1.7 m high. A robot beside the path is 0.3 to 0.5 m aside and turned by 10 to 20
// degrees.
[[nodiscard]] MatrixTask DrawTask(const MatrixCell& cell, const TruePath& taught,
                                  const sim::CameraModel& camera, std::uint64_t seed);

}  // namespace trailcast::trial
