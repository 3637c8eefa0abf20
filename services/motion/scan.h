#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace trailcast::motion {

// One sweep of a scanner that turns in a plane.
struct Scan {
  double first_rad = 0.0;  // counter-clockwise from straight ahead
  double step_rad = 0.0;   // from each range to the next; negative: clockwise
  double least_m = 0.0;    // the range that it can measure
  double most_m = 0.0;
  std::vector<float> ranges_m;
};

constexpr std::size_t kMostRanges = 65536;

// Says whether a scanner can give this: it has 1 to kMostRanges ranges over at most two turns, and
// its angles, least range and step are finite.
[[nodiscard]] bool Plausible(const Scan& scan);

// Returns the distance that one of its ranges stands for. A range that cannot be measured (NaN,
// infinity, 0, less than the least range) gives nothing. Minus infinity means that something is too
// near to measure (REP 117) and counts as the least range.
[[nodiscard]] std::optional<double> Measured(const Scan& scan, float range_m);

// Says whether the scanner looks to an angle, counter-clockwise from straight ahead.
[[nodiscard]] bool LooksTo(const Scan& scan, double angle_rad);

}  // namespace trailcast::motion
