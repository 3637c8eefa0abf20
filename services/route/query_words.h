#pragma once

#include <map>
#include <optional>
#include <string>

#include "services/base/result.h"
#include "services/route/route_query.h"

namespace trailcast::route {

// What people and programs call what a query asks for.

[[nodiscard]] const std::map<std::string, RouteOrder>& OrderWords();  // "newest"

// Being taught, or taught completely; what is complete has a standing besides.
struct StateWord {
  RouteState state = RouteState::kComplete;
  std::optional<Standing> standing{};
};
[[nodiscard]] const std::map<std::string, StateWord>& StateWords();  // "active"

// "48.2,11.5": on the globe latitude and longitude, on a site metres east and north.
// kInvalidArgument for anything else, and for what is no place.
[[nodiscard]] Result<Place> ReadPlace(Place::Frame frame, const std::string& text);

}  // namespace trailcast::route
