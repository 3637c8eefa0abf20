#pragma once

#include <cstdint>
#include <string>

#include "services/exchange/route_finder.h"

namespace trailcast::agent {

// The route that a control loop wants to have ready beside the present one.
struct RouteWish {
  std::uint32_t number = 0;  // number of the wish, from 1; each item fed for it has it
  std::string route;         // name, or an id or its beginning
  exchange::RevisionChoice revision{};
  double begin_m = 0.0;  // how far along the route the robot will come onto it
};

}  // namespace trailcast::agent
