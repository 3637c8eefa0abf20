#pragma once

#include <span>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// More than any info within bounds takes.
inline constexpr std::size_t kMaxInfoBytes = 16U << 10U;

// A complete route's info in the route format (trailcast.format.v1.Route). Equal infos give equal
// bytes. The state is not written.
[[nodiscard]] Bytes EncodeInfo(const RouteInfo& info);

// The state is kComplete. kCorrupt for bytes that are no such message; whether what it says is
// within bounds is the caller's to check.
[[nodiscard]] Result<RouteInfo> DecodeInfo(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::route
