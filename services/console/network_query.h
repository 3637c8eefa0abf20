#pragma once

#include <cstdint>
#include <string>

namespace trailcast::console {

// Which part of the network is drawn.
struct NetworkQuery {
  std::string search{};      // is in the name of a route, or of a place on it; empty: all
  std::string around{};      // a route, and those that joints lead to or from, the nearest first
  std::string of{};          // a route, and those that joints, proposed ones too, lead to or from
  std::uint32_t limit = 60;  // routes
};

}  // namespace trailcast::console
