#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace trailcast::junctions {

struct Weighed {
  double value = 0.0;
  double weight = 0.0;
};

// Returns nothing if there are no values.
[[nodiscard]] inline std::optional<double> Median(std::vector<Weighed> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end(),
            [](const Weighed& x, const Weighed& y) { return x.value < y.value; });
  double half = 0.0;
  for (const Weighed& each : values) half += 0.5 * each.weight;
  for (const Weighed& each : values) {
    half -= each.weight;
    if (half <= 0.0) return each.value;
  }
  return values.back().value;
}

}  // namespace trailcast::junctions
