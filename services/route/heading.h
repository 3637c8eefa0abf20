#pragma once

#include "services/route/route.h"

namespace trailcast::route {

// Returns the taught heading in radians after `distance_m` of a segment, counter-clockwise and
// relative to the segment's start.
[[nodiscard]] inline double HeadingAt(const HeadingPolynomial& heading, double distance_m) {
  const auto& c = heading.c;
  return distance_m * (c[0] + distance_m * (c[1] + distance_m * c[2]));
}

}  // namespace trailcast::route
