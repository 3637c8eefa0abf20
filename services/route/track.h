#pragma once

#include <algorithm>
#include <iterator>

#include "services/route/route.h"

namespace trailcast::route {

// A feature's taught place at fraction `s` of its segment: straight between its knots, and on along
// the last stretch for s beyond 1.
[[nodiscard]] inline TrackKnot TaughtPlace(const Feature& feature, double s) {
  const auto& track = feature.track;
  auto after = std::find_if(std::next(track.begin()), std::prev(track.end()),
                            [s](const TrackKnot& knot) { return knot.s >= s; });
  const auto before = std::prev(after);
  const float w = (static_cast<float>(s) - before->s) / std::max(1e-6F, after->s - before->s);
  return {static_cast<float>(s), before->u_px + w * (after->u_px - before->u_px),
          before->v_px + w * (after->v_px - before->v_px)};
}

}  // namespace trailcast::route
