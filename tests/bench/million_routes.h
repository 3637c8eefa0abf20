#pragma once

#include <cstdint>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/store/route_store.h"

namespace trailcast::bench {

inline constexpr std::uint32_t kMillion = 1'000'000;

// Returns one of a million routes, without its segments. There are ten revisions of each name and a
// thousand routes of each site's tag, begun anywhere on ten kilometres.
[[nodiscard]] route::RouteInfo RouteNumber(std::uint32_t n);

// Puts all of them.
[[nodiscard]] Result<void> PutMillionRoutes(store::RouteStore& store);

}  // namespace trailcast::bench
