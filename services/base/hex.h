#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace trailcast {

// Returns two lower-case hexadecimal digits for each byte.
[[nodiscard]] std::string ToHex(std::span<const std::uint8_t> bytes);

// Says whether `text` has such digits alone. An empty text has.
[[nodiscard]] bool IsHex(std::string_view text);

}  // namespace trailcast
