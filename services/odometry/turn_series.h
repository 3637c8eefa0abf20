#pragma once

#include <optional>
#include <vector>

namespace trailcast::odometry {

// Something that was measured at rising times, seconds.
struct TimedValue {
  double t_s = 0.0;
  double value = 0.0;
};

// Between the two about it, or the first or last one. Not empty.
[[nodiscard]] double ValueAt(const std::vector<TimedValue>& series, double t_s);

struct LagOptions {
  double longest_s = 0.5;  // either way
  double period_s = 0.1;   // over which a change is taken
  double clear = 0.8;      // so well the two have to agree (a correlation) for a lag to be known
};

struct Lag {
  double s = 0.0;
  double correlation = 0.0;  // of the changes, -1 to 1
};

// How much later than `reference` the changes of `series` come: where both agree best, if that is
// clear, in steps of 10 ms. Their scales may differ, and their signs, which the correlation's sign
// tells; so may what both change by all the while. Nothing: either does not change, or they have
// too little to do with each other, or agree best at the end of what is looked at.
[[nodiscard]] std::optional<Lag> LagOf(const std::vector<TimedValue>& series,
                                       const std::vector<TimedValue>& reference,
                                       const LagOptions& options = {});

}  // namespace trailcast::odometry
