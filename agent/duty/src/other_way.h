#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "services/mission/orders.h"

namespace trailcast::agent {

// What a robot does that is told another way while it follows an order.
struct OtherWay {
  enum class Kind {
    kGoesOn,  // on its route, to where that order of the other way ends
    kBegins,  // it stands, and begins that order
    kMissed,  // it stands: it has passed where it was to leave its route
  };
  Kind kind = Kind::kBegins;
  std::uint32_t task = 0;  // of the other way
};

// A robot's place and that of an order are the same within this; further on it has passed it.
inline constexpr double kOnWay_m = 0.5;
inline constexpr double kPassed_m = 0.3;

// `driven`: the order it follows; `along_m`: where it is on that route, if it has found itself.
[[nodiscard]] OtherWay FindOnWay(std::span<const mission::Task> way, const mission::Task& driven,
                                 std::optional<double> along_m);

}  // namespace trailcast::agent
