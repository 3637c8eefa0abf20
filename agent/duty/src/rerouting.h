#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "services/mission/orders.h"

namespace trailcast::agent {

// The action of a robot that is sent another path while it follows an order.
struct Rerouting {
  enum class Kind {
    kGoesOn,  // it continues on its route, to the end of that order of the new path
    kBegins,  // it stops, and begins that order
    kMissed,  // it stops, because it has passed the place where it had to leave its route
  };
  Kind kind = Kind::kBegins;
  std::uint32_t task = 0;  // of the new path
};

// A robot is at an order's place within the first distance, and has passed it beyond the second.
inline constexpr double kOnPath_m = 0.5;
inline constexpr double kPassed_m = 0.3;

// `driven` is the order it follows; `along_m` is its place on that route, if it has found itself.
[[nodiscard]] Rerouting FindOnPath(std::span<const mission::Task> way, const mission::Task& driven,
                                   std::optional<double> along_m);

}  // namespace trailcast::agent
