#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace trailcast {

// Returns two lower-case hexadecimal digits for each byte.
[[nodiscard]] std::string ToHex(std::span<const std::uint8_t> bytes);

}  // namespace trailcast
