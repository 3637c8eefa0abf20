#pragma once

#include <optional>
#include <vector>

namespace trailcast::agent {

// Something that was measured at rising times, seconds.
struct TimedValue {
  double t_s = 0.0;
  double value = 0.0;
};

// Between the two about it, or the first or last one. Not empty.
[[nodiscard]] double ValueAt(const std::vector<TimedValue>& series, double t_s);

// How much later than `reference` the changes of `series` come: where both agree best, if that is
// clear, up to half a second either way and in steps of 10 ms. Their signs and scales may differ.
[[nodiscard]] std::optional<double> LagOf(const std::vector<TimedValue>& series,
                                          const std::vector<TimedValue>& reference);

}  // namespace trailcast::agent
