#include "services/base/ids.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <random>

namespace trailcast {

RouteId MakeRouteId() {
  std::random_device random;
  std::string digits;
  for (int i = 0; i < 4; ++i) digits += fmt::format("{:08x}", random());
  return RouteId(digits);
}

TeachingId MakeTeachingId() {
  std::random_device random;
  std::uniform_int_distribution<std::uint64_t> any(1, std::numeric_limits<std::int64_t>::max());
  return TeachingId(any(random));
}

bool IsValidName(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-';
  };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), allowed);
}

}  // namespace trailcast
