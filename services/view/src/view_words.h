#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/route/route.h"

namespace trailcast::view {

// The index's tables go by these parts of a descriptor. They are for the index's own sources.

inline constexpr std::size_t kTables = 2;
inline constexpr unsigned kWordBits = 20;
inline constexpr unsigned kCheckBits = 12;
inline constexpr std::uint32_t kWords = 1U << kWordBits;
inline constexpr std::uint32_t kCheckMask = (1U << kCheckBits) - 1U;

// This is where a feature is found in each table: its word there, and its check, which tells apart
// features that share a word: the upper bits of its word in the other table.
struct Where {
  std::uint32_t word = 0;
  std::uint32_t check = 0;
};
[[nodiscard]] std::array<Where, kTables> WhereIs(const route::Descriptor& descriptor);

// Returns all words with at most two bits set, which are flipped to search around a word.
[[nodiscard]] const std::vector<std::uint32_t>& Flips();

// Returns, for the bits in which two checks differ, whether they may be of one feature.
[[nodiscard]] const std::array<bool, kCheckMask + 1>& FewFlips();

}  // namespace trailcast::view
