#pragma once

#include <cstdint>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/store/route_store.h"

namespace trailcast::bench {

inline constexpr std::uint32_t kMillion = 1'000'000;

// Ten revisions of a name, a thousand routes of a site's tag, begun anywhere on ten kilometres;
// without their segments.
[[nodiscard]] route::RouteInfo RouteNumber(std::uint32_t n);

// Puts all of them.
[[nodiscard]] Result<void> PutMillionRoutes(store::RouteStore& store);

}  // namespace trailcast::bench
