#pragma once

#include <cstdint>
#include <string>

namespace trailcast::console {

// This is the part of the network that is drawn.
struct NetworkQuery {
  std::string search{};  // a part of a route's name, or of a place's on it; empty for all
  std::string around{};  // a route, and those that junctions lead to or from, the nearest first
  std::string of{};      // a route, and those that junctions, also proposed ones, lead to or from
  std::uint32_t limit = 60;  // in routes
};

}  // namespace trailcast::console
