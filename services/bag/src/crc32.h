#pragma once

#include <cstdint>
#include <span>

namespace trailcast::bag {

// Returns the CRC-32 of zlib and MCAP: polynomial 0x04C11DB7, reflected.
[[nodiscard]] std::uint32_t Crc32(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::bag
