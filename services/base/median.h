#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trailcast {

// Returns the median of at least one value; the upper middle one if their number is even.
[[nodiscard]] inline double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace trailcast
