#pragma once

#include <cstdint>
#include <string>

#include "services/exchange/route_finder.h"

namespace trailcast::agent {

// Which route a control loop wants to have ready beside the one that it follows.
struct RouteWish {
  std::uint32_t number = 0;  // of its wishes, from 1; what is fed says which it is of
  std::string route;         // name, or an id or its beginning
  exchange::RevisionChoice revision{};
  double begin_m = 0.0;  // how far along it the robot will come onto it
};

}  // namespace trailcast::agent
