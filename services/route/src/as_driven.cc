#include "services/route/as_driven.h"

#include <algorithm>
#include <cmath>

#include "services/route/heading.h"
#include "services/route/usual_camera.h"

namespace trailcast::route {

Segment AsDriven(Segment segment) {
  if (segment.has_odometry || !segment.seen_heading || segment.duration_s <= 0.0) return segment;
  constexpr int kSteps = 16;  // of a cubic's extremes
  segment.has_odometry = true;
  segment.length_m = kUsualSpeed_mps * segment.duration_s;
  double metres = 1.0;
  for (std::size_t i = 0; i < segment.heading.c.size(); ++i) {
    metres *= kUsualSpeed_mps;
    segment.heading.c[i] = segment.seen_heading->c[i] / metres;
  }
  segment.heading_change_rad = HeadingAt(segment.heading, segment.length_m);
  for (int i = 1; i <= kSteps; ++i) {
    const double heading_rad = HeadingAt(segment.heading, segment.length_m * i / kSteps);
    segment.heading_variation_rad = std::max(segment.heading_variation_rad, std::abs(heading_rad));
  }
  return segment;
}

}  // namespace trailcast::route
