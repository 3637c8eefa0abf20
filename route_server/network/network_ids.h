#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "services/base/number.h"
#include "services/route/route.h"

namespace trailcast::server {

// Returns a revision's name in the network.
[[nodiscard]] inline std::string IdOf(const route::RouteKey& key) {
  return fmt::format("{}/{}", key.route.value(), key.teaching.value());
}

[[nodiscard]] inline route::RouteKey KeyOf(const std::string& id) {
  const std::size_t slash = std::min(id.find('/'), id.size());
  const auto teaching =
      ParseNumber<std::uint64_t>(std::string_view(id).substr(std::min(slash + 1, id.size())));
  return {RouteId(id.substr(0, slash)), TeachingId(teaching.value_or(0))};
}

[[nodiscard]] inline double ToCentimetre(double metres) {
  return std::round(metres * 100.0) / 100.0;
}

}  // namespace trailcast::server
