#pragma once

#include <span>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// No info within bounds takes as much as this.
inline constexpr std::size_t kMaxInfoBytes = 16U << 10U;

// Returns an info in the route format (trailcast.format.v1.Route). Equal infos give equal bytes.
[[nodiscard]] Bytes EncodeInfo(const RouteInfo& info);

// Fails with kCorrupt for bytes that are no such message, and for values that no route can have
// (bounds.h).
[[nodiscard]] Result<RouteInfo> DecodeInfo(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::route
