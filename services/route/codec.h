#pragma once

#include <span>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// These limit what is accepted from a wire or a disk.
inline constexpr std::size_t kMaxSegmentBytes = 1U << 20U;
inline constexpr std::size_t kMaxFeatures = 1024;
inline constexpr std::size_t kMaxKnots = 64;
// No camera has a pixel further than this from the image centre.
inline constexpr int kMaxCoordinatePx = 1 << 16;

inline constexpr std::size_t kMaxKeyViews = 64;
inline constexpr std::size_t kMaxKeyViewFeatures = 255;

// This is the version of the route format. No other version is read.
inline constexpr std::uint32_t kFormatVersion = 4;

// Returns a segment in the route format (idl/route.proto). Equal segments give equal bytes.
// Coordinates are rounded to 1/16 px, lengths to 0.1 mm, angles to 0.01 mrad, durations to 1 ms,
// knot times to 1/255, and the heading polynomial to single precision. The first knot's time is
// written as 0 and the last one's as 1. A knot between them that rounds to its neighbour is left
// out. In key views, places are rounded to 1/4 px, sizes to a sixteenth of an octave, and `s` to
// 1/255. In the terrain, shaking is rounded to 1/10000 of the picture, acceleration to 1 cm/s2, and
// slope to 1 mrad.
// It expects at most kMaxFeatures features of 2 to kMaxKnots knots each, at most kMaxKeyViews key
// views of kMaxKeyViewFeatures features, finite numbers, and odometry if the segment is driven
// backwards. Descriptors of features are written if any feature has one.
[[nodiscard]] Bytes Encode(const Segment& segment);

// Fails with kCorrupt and what is wrong for bytes that are no segment: truncated or oversize ones,
// absurd counts, knots out of order, and numbers that are not finite. It trusts no byte and never
// throws.
[[nodiscard]] Result<Segment> Decode(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::route
