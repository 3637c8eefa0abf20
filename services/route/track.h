#pragma once

#include <algorithm>
#include <iterator>

#include "services/route/route.h"

namespace trailcast::route {

// These are the two knots that a fraction of a segment lies between, and the weight of the later
// one, which is above 1 beyond the last knot.
struct TrackInterval {
  TrackKnot before;
  TrackKnot after;
  float weight = 0.0F;
};
[[nodiscard]] inline TrackInterval IntervalAt(const Feature& feature, double s) {
  const auto& track = feature.track;
  const auto after = std::find_if(std::next(track.begin()), std::prev(track.end()),
                                  [s](const TrackKnot& knot) { return knot.s >= s; });
  const auto before = std::prev(after);
  return {*before, *after,
          (static_cast<float>(s) - before->s) / std::max(1e-6F, after->s - before->s)};
}

// Returns a feature's taught place at fraction `s` of its segment. It is interpolated linearly
// between knots and, for s beyond 1, extrapolated from the last two.
[[nodiscard]] inline TrackKnot TaughtPlace(const Feature& feature, double s) {
  const auto [before, after, w] = IntervalAt(feature, s);
  return {static_cast<float>(s), before.u_px + w * (after.u_px - before.u_px),
          before.v_px + w * (after.v_px - before.v_px)};
}

}  // namespace trailcast::route
