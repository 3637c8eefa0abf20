#include "services/replay/src/as_forward.h"

#include <algorithm>

namespace trailcast::replay {
namespace {

// h(L - x) - h(L): against the metres from the other end, and counted from there.
route::HeadingPolynomial FromTheEnd(const route::HeadingPolynomial& heading, double length_m) {
  const auto& c = heading.c;
  return {{-(c[0] + length_m * (2.0 * c[1] + 3.0 * length_m * c[2])), c[1] + 3.0 * length_m * c[2],
           -c[2]}};
}

}  // namespace

route::Segment AsForward(const route::Segment& segment) {
  route::Segment forward = segment;
  forward.key_views.clear();
  if (!segment.reverse) return forward;
  forward.heading = FromTheEnd(segment.heading, segment.length_m);
  forward.heading_change_rad = -segment.heading_change_rad;
  for (route::Feature& feature : forward.features) {
    std::reverse(feature.track.begin(), feature.track.end());
    for (route::TrackKnot& knot : feature.track) knot.s = 1.0F - knot.s;
  }
  return forward;
}

}  // namespace trailcast::replay
