#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/route/route_ref.h"

namespace trailcast::mission {

// What a mission consists of, one after the other:
//   follow ROUTE[@REVISION] [FROM..TO] [laps N] [speed F]   metres along the route, either may be
//                                                           missing; F times the taught speed
//   teach ROUTE [TAG ...]    a person drives until it is told to be ended; no tag is called as what
//                            an order begins with
//   wait SECONDS
// as in "follow hall 3..10 speed 0.5 wait 20 teach yard wet gravel".
struct Task {
  enum class Kind : std::uint8_t { kFollow, kWait, kTeach };
  Kind kind = Kind::kFollow;
  route::RouteRef route{};
  double from_m = 0.0;  // where the robot stands at first; 0: at the route's beginning
  double to_m = 0.0;    // where it ends; 0: at the route's end
  std::uint32_t laps = 1;
  double speed_factor = 1.0;
  double wait_s = 0.0;
  std::vector<std::string> tags{};  // of what is taught, in any order
};

// kInvalidArgument, with the word that was not understood and what was expected.
[[nodiscard]] Result<std::vector<Task>> ParseOrders(std::string_view orders);

// Those that they name; none where they are not understood.
[[nodiscard]] std::set<std::string> RoutesIn(std::string_view orders);

// "follow hall 3..10": as ParseOrders takes it, without what is as usual.
[[nodiscard]] std::string ToText(const Task& task);

}  // namespace trailcast::mission
