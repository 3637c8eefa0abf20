#include "services/route/as_driven.h"

#include <algorithm>
#include <cmath>

#include "services/route/heading.h"
#include "services/route/usual_camera.h"

namespace trailcast::route {

Segment AsDriven(Segment segment) {
  if (segment.has_odometry || !segment.seen_way) return segment;
  constexpr int kSteps = 16;  // search for the cubic's extremes
  segment.has_odometry = true;
  segment.length_m = segment.seen_way->length_m;
  segment.duration_s = segment.length_m / kUsualSpeed_mps;
  segment.heading = segment.seen_way->heading;
  segment.heading_change_rad = HeadingAt(segment.heading, segment.length_m);
  for (int i = 1; i <= kSteps; ++i) {
    const double heading_rad = HeadingAt(segment.heading, segment.length_m * i / kSteps);
    segment.heading_variation_rad = std::max(segment.heading_variation_rad, std::abs(heading_rad));
  }
  return segment;
}

}  // namespace trailcast::route
