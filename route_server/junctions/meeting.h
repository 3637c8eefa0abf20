#pragma once

#include <algorithm>
#include <optional>

#include "services/route/route.h"

namespace trailcast::server {

// Without an operator, a meeting counts from this confidence on.
inline constexpr double kSure = 0.9;

// Two routes may still turn towards each other where they begin to look alike. A robot changes over
// so far further on, but at most half way along their common section.
inline constexpr double kInto_m = 3.0;
[[nodiscard]] inline double IntoShared_m(double length_m) {
  return std::min(kInto_m, length_m / 2.0);
}

// Two revisions, or two parts of one, that come to the same place looking the same way, and run on
// together.
struct Meeting {
  route::RouteKey a;
  route::RouteKey b;
  double at_a_m = 0.0;  // where a robot may change over
  double at_b_m = 0.0;
  double length_m = 0.0;                // of their common section
  std::optional<double> heading_rad{};  // how much further left b looks, if that is known
  double confidence = 0.0;              // 0.5 to 1

  bool operator==(const Meeting&) const = default;
};

}  // namespace trailcast::server
