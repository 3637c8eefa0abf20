#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/motion/motion.h"

namespace trailcast::motion {

// One look of a scanner that turns in a plane.
struct Scan {
  double first_rad = 0.0;  // counter-clockwise from straight ahead
  double step_rad = 0.0;   // from each range to the next; negative: clockwise
  double least_m = 0.0;    // what it can measure
  double most_m = 0.0;
  std::vector<float> ranges_m;
};

constexpr std::size_t kMostRanges = 65536;

// Whether it can be a scanner's: at least one and at most kMostRanges ranges over at most two
// turns, angles and the least range finite, a step that is one.
[[nodiscard]] bool Plausible(const Scan& scan);

// What a scanner sees that looks `ahead_m` in front of the axle, seen from the axle: x ahead, y
// left. What it cannot measure (NaN, infinite, below its least range, 0) is nothing there; minus
// infinity is something nearer than it can measure (REP 117), and put at its least range.
[[nodiscard]] std::vector<Eigen::Vector2d> Points(const Scan& scan, double ahead_m);

// A robot from above: from its axle so far to the front, and to either side. Behind the axle it is
// taken to reach as far as to a side.
struct Outline {
  double front_m = 0.25;
  double side_m = 0.25;
};

// How fast some part of it goes: the axle, or on a tighter turn its side.
[[nodiscard]] double Pace(const Outline& outline, const VelocityCommand& command);

struct InTheWay {
  double way_m = 0.0;  // at that pace, until the robot touches it
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
};

// The first of `points` that a robot meets which goes on as `command` says, for half a turn at
// most; nothing: none, or it stands. Turning on the spot it meets at once whatever is within the
// circle that its front corners sweep.
[[nodiscard]] std::optional<InTheWay> FirstMet(const std::vector<Eigen::Vector2d>& points,
                                               const Outline& outline,
                                               const VelocityCommand& command);

}  // namespace trailcast::motion
