#pragma once

#include <cstdint>
#include <span>

namespace trailcast::bag {

// CRC-32 as in zlib and MCAP: polynomial 0x04C11DB7, reflected.
[[nodiscard]] std::uint32_t Crc32(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::bag
