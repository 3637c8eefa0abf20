#pragma once

#include <optional>
#include <vector>

namespace trailcast::odometry {

// A value that was measured at a time; times rise along a series.
struct TimedValue {
  double t_s = 0.0;
  double value = 0.0;
};

// Interpolates in a series that is not empty; outside of it, the first or the last value holds.
[[nodiscard]] double ValueAt(const std::vector<TimedValue>& series, double t_s);

struct LagOptions {
  double longest_s = 0.5;  // either way
  double period_s = 0.1;   // the span over which a change is taken
  double clear = 0.8;      // the correlation that a lag needs to count as known
};

struct Lag {
  double s = 0.0;
  double correlation = 0.0;  // of the changes, -1 to 1
};

// Returns how much later the changes of `series` come than those of `reference`, in steps of 10 ms.
// Scale, sign and a constant rate of change may differ; the correlation's sign tells the sign.
// Returns nothing if either series does not change, if they correlate too little, or if they agree
// best at the end of the range that is searched.
[[nodiscard]] std::optional<Lag> LagOf(const std::vector<TimedValue>& series,
                                       const std::vector<TimedValue>& reference,
                                       const LagOptions& options = {});

}  // namespace trailcast::odometry
