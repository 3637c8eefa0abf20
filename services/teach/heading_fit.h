#pragma once

#include <span>

#include "services/route/route.h"

namespace trailcast::teach {

struct HeadingSample {
  double distance_m = 0.0;   // driven since the segment's start
  double heading_rad = 0.0;  // counter-clockwise since the segment's start, not wrapped
};

// Returns the third-order polynomial through the origin that fits the samples best (least squares;
// Chen & Birchfield 2009, II.B). With fewer distinct distances than coefficients the order falls.
// All coefficients are zero for a segment without motion.
[[nodiscard]] route::HeadingPolynomial FitHeading(std::span<const HeadingSample> samples);

}  // namespace trailcast::teach
