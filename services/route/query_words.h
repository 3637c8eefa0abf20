#pragma once

#include <map>
#include <optional>
#include <string>

#include "services/base/result.h"
#include "services/route/route_query.h"

namespace trailcast::route {

// These are the words by which people and programs ask for routes.

[[nodiscard]] const std::map<std::string, RouteOrder>& OrderWords();  // "newest"

// A route is being taught or complete, and a complete one has a standing besides.
struct StateWord {
  RouteState state = RouteState::kComplete;
  std::optional<Standing> standing{};
};
[[nodiscard]] const std::map<std::string, StateWord>& StateWords();  // "active"

// Reads "48.2,11.5": latitude and longitude on the globe, metres east and north on a site. Fails
// with kInvalidArgument for anything else, and for coordinates that no place has.
[[nodiscard]] Result<Place> ReadPlace(Place::Frame frame, const std::string& text);

}  // namespace trailcast::route
