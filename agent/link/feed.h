#pragma once

#include <variant>

#include "agent/session/place_finder.h"
#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::agent {

// The items that a link gives the control loop, in this order: the route; where the robot was left
// on it or comes onto it, if it does; its segments; and that it is complete, or that no more of it
// can be had. An error says why nothing more will come.
struct RouteComplete {};
using Feed =
    std::variant<std::monostate, route::RouteInfo, LeftAt, route::Segment, RouteComplete, Error>;

}  // namespace trailcast::agent
