#pragma once

#include "services/route/route.h"

namespace trailcast::route {

// Taught heading, counter-clockwise from the segment's start, after `distance_m` of it.
[[nodiscard]] inline double HeadingAt(const HeadingPolynomial& heading, double distance_m) {
  const auto& c = heading.c;
  return distance_m * (c[0] + distance_m * (c[1] + distance_m * c[2]));
}

}  // namespace trailcast::route
