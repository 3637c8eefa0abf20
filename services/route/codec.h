#pragma once

#include <span>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// Limits on what is accepted from a wire or a disk.
inline constexpr std::size_t kMaxSegmentBytes = 1U << 20U;
inline constexpr std::size_t kMaxFeatures = 1024;
inline constexpr std::size_t kMaxKnots = 64;
// Farther than this from the image centre is no pixel of any camera.
inline constexpr int kMaxCoordinatePx = 1 << 16;

inline constexpr std::size_t kMaxKeyViews = 64;
inline constexpr std::size_t kMaxKeyViewFeatures = 255;

// The version of the route format; no other is read.
inline constexpr std::uint32_t kFormatVersion = 4;

// The route format (idl/route.proto), in bytes. Deterministic: equal segments give equal bytes.
// Coordinates are rounded to 1/16 px, lengths to 0.1 mm, angles to 0.01 mrad, durations to 1 ms,
// knot times to 1/255, the heading polynomial to single precision. The first knot's time is written
// as 0 and the last one's as 1; a knot between them that rounds onto its neighbour is left out.
// Of key views, places are rounded to 1/4 px, sizes to a sixteenth of an octave, `s` to 1/255. Of
// the terrain, shaking is rounded to 1/10000 of the picture, acceleration to 1 cm/s2, slope to 1
// mrad. Expects at most kMaxFeatures features of 2 to kMaxKnots knots each, kMaxKeyViews key views
// of kMaxKeyViewFeatures features, all numbers finite, odometry where it is driven backwards;
// descriptors of features are written if any of them has one.
[[nodiscard]] Bytes Encode(const Segment& segment);

// kCorrupt with what is wrong for bytes that are no segment: truncated, oversize, absurd counts,
// knots out of order, non-finite numbers. Never trusts, never throws.
[[nodiscard]] Result<Segment> Decode(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::route
