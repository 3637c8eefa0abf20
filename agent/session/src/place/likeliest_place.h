#pragma once

#include <optional>
#include <span>

#include "agent/session/src/place/route_place.h"

namespace trailcast::agent {

// Where a robot that stands sees a segment's features from, by those that lie as they would be seen
// from somewhere about there.
struct PlaceByFeatures {
  double along = 0.0;        // in the route's units; may be before its beginning or beyond its end
  double along_sigma = 0.0;  // by its features alone
  int agreeing = 0;
  double share = 0.0;  // of those that should be in the picture
  double magnification = 1.0;
  double speaks = 0.0;  // for it: features, less for a camera that it can hardly have
  RoutePoint by{};      // whose features these are, and from where they were looked for
};

struct LikeliestPlace {
  PlaceByFeatures best;
  // All that speaks for it about as well lies between these, itself too, each as far to either side
  // as its features may be wrong (one sigma).
  double first = 0.0;
  double last = 0.0;
};

// Nothing: none was compared.
[[nodiscard]] std::optional<LikeliestPlace> LikeliestOf(std::span<const PlaceByFeatures> compared);

}  // namespace trailcast::agent
