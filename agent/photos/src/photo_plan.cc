#include "agent/photos/photo_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/route/route_ref.h"

namespace trailcast::agent {
namespace {

// Two spots that are no further apart are one, of which one photo is taken.
constexpr double kSame_m = 0.01;

bool IsOn(const mission::PhotoPlace& place, const route::RouteInfo& route) {
  const bool any_revision = place.route.revision == 0;
  return route::IsMeantBy(route, place.route.route) &&
         (any_revision || place.route.revision == route.revision.value());
}

}  // namespace

PhotoPlan::PhotoPlan(const mission::PhotoWish& wish, const route::RouteInfo& route, bool backwards)
    : every_m_(wish.every_m), backwards_(backwards) {
  for (const mission::PhotoPlace& place : wish.at) {
    if (IsOn(place, route)) places_.push_back({{place.along_m, place.name}, ToText(place)});
  }
}

std::optional<PhotoPlan::Spot> PhotoPlan::Due(double along_m, bool at_end) const {
  const double until_m = Driven(along_m) + (at_end ? kNear_m : 0.0);
  double after_m = Driven(along_m) - kNear_m;
  if (reached_m_) after_m = std::max(after_m, *reached_m_ + kSame_m);
  std::optional<Spot> first;
  const auto offer = [&](Spot spot) {
    const double driven_m = Driven(spot.at_m);
    if (driven_m < after_m || driven_m > until_m) return;
    // A place with a name comes before a spot without one.
    if (!first || driven_m < Driven(first->at_m) + (spot.place.empty() ? 0.0 : kSame_m)) {
      first = std::move(spot);
    }
  };
  if (every_m_ > 0.0) {
    const double next_m = every_m_ * std::ceil(after_m / every_m_);
    if (Driven(next_m) >= 0.0) offer({.at_m = std::abs(next_m)});
  }
  for (const Place& place : places_) offer(place.spot);
  return first;
}

void PhotoPlan::NoteTaken(const Spot& spot) {
  reached_m_ = Driven(spot.at_m);
  for (Place& place : places_) {
    place.taken = place.taken || std::abs(place.spot.at_m - spot.at_m) <= kSame_m;
  }
}

std::set<std::string> PhotoPlan::Photographed() const {
  std::set<std::string> words;
  for (const Place& place : places_) {
    if (place.taken) words.insert(place.words);
  }
  return words;
}

}  // namespace trailcast::agent
