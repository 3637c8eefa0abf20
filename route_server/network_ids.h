#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "services/route/route.h"

namespace trailcast::server {

// What a network is told to call a revision.
[[nodiscard]] inline std::string IdOf(const route::RouteKey& key) {
  return fmt::format("{}/{}", key.route.value(), key.teaching.value());
}

[[nodiscard]] inline double ToCentimetre(double metres) {
  return std::round(metres * 100.0) / 100.0;
}

}  // namespace trailcast::server
