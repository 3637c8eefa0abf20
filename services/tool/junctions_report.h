#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/junctions/find_junctions.h"
#include "services/route/route.h"

namespace trailcast::tool {

// This is a route in which junctions are looked for.
struct JoinableRoute {
  route::RouteInfo info;
  junctions::RouteViews views;
};

struct FoundJunction {
  std::size_t a = 0;  // positions among the routes; equal for a route that comes back
  std::size_t b = 0;
  junctions::Junction junction;
};

// Looks for junctions of every two of `routes` and of each with itself, or, if `only_first`, of the
// first with each.
[[nodiscard]] std::vector<FoundJunction> FindAllJunctions(const std::vector<JoinableRoute>& routes,
                                                          bool only_first);

// Returns a line for each junction: "hall@12.0 office@0.4 for 5.3 m, agreed by 43 features, 0.97
// sure, 3 degrees to the left". Routes of the same name are called by their ids. Places on routes
// that were taught without odometry are in seconds of teaching: "hall@12.0s".
[[nodiscard]] std::string JunctionsText(const std::vector<JoinableRoute>& routes,
                                        const std::vector<FoundJunction>& found);
// Returns one object, for programs.
[[nodiscard]] nlohmann::ordered_json JunctionsJson(const std::vector<JoinableRoute>& routes,
                                                   const std::vector<FoundJunction>& found);

}  // namespace trailcast::tool
