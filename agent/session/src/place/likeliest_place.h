#pragma once

#include <optional>
#include <span>

#include "agent/session/src/place/route_place.h"

namespace trailcast::agent {

// This is where a robot that stands sees a segment's features from, by those that lie as they would
// be seen from somewhere around there.
struct PlaceByFeatures {
  double along = 0.0;        // in the route's units; may be before its beginning or beyond its end
  double along_sigma = 0.0;  // by its features alone
  int agreeing = 0;
  double share = 0.0;  // share of those that should be in the picture
  double magnification = 1.0;
  double speaks = 0.0;  // supporting features, less for an unlikely camera
  RoutePoint by{};      // the segment of these features, and from where they were looked for
};

struct LikeliestPlace {
  PlaceByFeatures best;
  // All places with about as much support, itself included, lie between these, each widened to
  // either side by its standard deviation.
  double first = 0.0;
  double last = 0.0;
};

// Returns nothing if none was compared.
[[nodiscard]] std::optional<LikeliestPlace> LikeliestOf(std::span<const PlaceByFeatures> compared);

}  // namespace trailcast::agent
