#pragma once

#include <cstddef>
#include <optional>
#include <vector>

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

// How far what one of its ranges saw is. What it cannot measure (NaN, infinite, below its least
// range, 0) is nothing; minus infinity is something nearer than it can measure (REP 117), and put
// at its least range.
[[nodiscard]] std::optional<double> Measured(const Scan& scan, float range_m);

// Whether it looks that way at all: counter-clockwise from straight ahead.
[[nodiscard]] bool LooksTo(const Scan& scan, double angle_rad);

}  // namespace trailcast::motion
