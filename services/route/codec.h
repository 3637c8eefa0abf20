#pragma once

#include <span>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// Limits on what is accepted from a wire or a disk.
inline constexpr std::size_t kMaxSegmentBytes = 1U << 20U;
inline constexpr std::size_t kMaxFeatures = 1024;
inline constexpr std::size_t kMaxKnots = 64;

// The route format (idl/route.proto), in bytes. Deterministic: equal segments give equal bytes.
// Coordinates are rounded to 1/16 px, lengths to 0.1 mm, angles to 0.01 mrad.
[[nodiscard]] Bytes Encode(const Segment& segment);

// kCorrupt with what is wrong for bytes that are no segment: truncated, oversize, absurd counts,
// knots out of order, non-finite numbers. Never trusts, never throws.
[[nodiscard]] Result<Segment> Decode(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::route
