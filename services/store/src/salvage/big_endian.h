#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace trailcast::store {

// Returns the `count` bytes from `at` on, at most 8, as a number of SQLite's files. All must be
// there.
[[nodiscard]] inline std::uint64_t BigEndian(std::span<const std::uint8_t> bytes, std::size_t at,
                                             std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8U | bytes[at + i];
  return value;
}

}  // namespace trailcast::store
