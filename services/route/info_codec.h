#pragma once

#include <span>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// More than any info within bounds takes.
inline constexpr std::size_t kMaxInfoBytes = 16U << 10U;

// An info in the route format (trailcast.format.v1.Route). Equal infos give equal bytes.
[[nodiscard]] Bytes EncodeInfo(const RouteInfo& info);

// kCorrupt for bytes that are no such message, or that say what no route can be (bounds.h).
[[nodiscard]] Result<RouteInfo> DecodeInfo(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::route
