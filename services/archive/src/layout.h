#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "services/route/route.h"

namespace trailcast::archive {

// A route file (docs/reference/route-format.md, "A route as a file"), numbers little-endian:
//   preamble: magic, u32 version, u32 size of the description, u64 size of the whole file
//   the description: route::EncodeInfo, AsTaught
//   each segment in order: u32 index, u32 size, digest, the bytes that were hashed
//   SHA-256 of everything before
inline constexpr std::string_view kMagic = "TRCROUTE";
inline constexpr std::size_t kVersionAt = kMagic.size();
inline constexpr std::size_t kInfoSizeAt = kVersionAt + 4;
inline constexpr std::size_t kFileSizeAt = kInfoSizeAt + 4;
inline constexpr std::size_t kPreambleBytes = kFileSizeAt + 8;
inline constexpr std::size_t kFrameDigestAt = 8;
inline constexpr std::size_t kFrameBytes = kFrameDigestAt + std::tuple_size_v<route::Digest>;
inline constexpr std::size_t kChecksumBytes = std::tuple_size_v<route::Digest>;

inline void AppendNumber(route::Bytes& out, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) {
    out.push_back(static_cast<std::uint8_t>(value >> (8U * i)));
  }
}

[[nodiscard]] inline std::uint64_t NumberAt(std::span<const std::uint8_t> in, std::size_t at,
                                            std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes; i > 0; --i) value = value << 8U | in[at + i - 1];
  return value;
}

// Returns a route's description as a file has it. Operators' decisions about the route stay at the
// server where they were made.
[[nodiscard]] inline route::RouteInfo AsTaught(route::RouteInfo info) {
  info.standing = route::Standing::kStaged;
  info.edition = 0;
  return info;
}

}  // namespace trailcast::archive
