#pragma once

#include <variant>

#include "agent/session/place_finder.h"
#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::agent {

// What a link gives the control loop of a route, in this order: the route, where the robot was left
// on it, or comes onto it (if it does), its segments, that it is complete (or that no more can be
// had); or why there will be nothing more.
struct RouteComplete {};
using Feed =
    std::variant<std::monostate, route::RouteInfo, LeftAt, route::Segment, RouteComplete, Error>;

}  // namespace trailcast::agent
