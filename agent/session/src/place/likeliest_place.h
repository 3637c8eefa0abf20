#pragma once

#include <optional>
#include <span>
#include <string>

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

// This is how much of a route is known.
struct RouteExtent {
  double length = 0.0;  // in the route's units
  bool metric = true;   // those are metres
};

// Describes a part of the route for people.
[[nodiscard]] std::string InWords(double way, const RouteExtent& route);

// Places no further apart than this, in the route's units, count as one.
inline constexpr double kOnePlace = 3.0;

// This is where a robot begins to follow by what was compared.
struct Beginning {
  std::optional<LikeliestPlace> place;
  std::string nowhere;  // why at none of them; empty if too few features agree anywhere
};

// Returns the likeliest place, if it is one place, on the route, where `enough` features agree.
[[nodiscard]] Beginning BeginningBy(std::span<const PlaceByFeatures> compared, int enough,
                                    const RouteExtent& route);

}  // namespace trailcast::agent
