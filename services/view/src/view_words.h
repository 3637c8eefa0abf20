#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/route/route.h"

namespace trailcast::view {

// For the index's own sources: what of a descriptor its tables go by.

inline constexpr std::size_t kTables = 2;
inline constexpr unsigned kWordBits = 20;
inline constexpr unsigned kCheckBits = 12;
inline constexpr std::uint32_t kWords = 1U << kWordBits;
inline constexpr std::uint32_t kCheckMask = (1U << kCheckBits) - 1U;

// Where a feature is found in each table: its word there, and, to tell apart what shares a word,
// the upper bits of its word in the other.
struct Where {
  std::uint32_t word = 0;
  std::uint32_t check = 0;
};
[[nodiscard]] std::array<Where, kTables> WhereIs(const route::Descriptor& descriptor);

// All words with at most two bits set: what is flipped to look around a word.
[[nodiscard]] const std::vector<std::uint32_t>& Flips();

// Whether two checks that differ in these bits may be of one feature.
[[nodiscard]] const std::array<bool, kCheckMask + 1>& FewFlips();

}  // namespace trailcast::view
