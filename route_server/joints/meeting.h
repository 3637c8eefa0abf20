#pragma once

#include <algorithm>
#include <optional>

#include "services/route/route.h"

namespace trailcast::server {

// Who does not ask an operator believes what is found from this confidence on.
inline constexpr double kSure = 0.9;

// Where two routes begin to look alike they may still turn towards each other: one changes over so
// far further on, half way through what they share at most.
inline constexpr double kInto_m = 3.0;
[[nodiscard]] inline double IntoShared_m(double length_m) {
  return std::min(kInto_m, length_m / 2.0);
}

// Two revisions, or two parts of one, that come to the same place looking the same way, and run on
// together.
struct Meeting {
  route::RouteKey a;
  route::RouteKey b;
  double at_a_m = 0.0;  // where one may change over
  double at_b_m = 0.0;
  double length_m = 0.0;                // of what they share
  std::optional<double> heading_rad{};  // how much further left b looks, where that is known
  double confidence = 0.0;              // 0.5 to 1

  bool operator==(const Meeting&) const = default;
};

}  // namespace trailcast::server
