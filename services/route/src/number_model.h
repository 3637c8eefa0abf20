#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "services/route/src/bit_coder.h"

namespace trailcast::route {

// This is a bit whose probability is learnt from those before it, quickly at first.
class LearntBit {
 public:
  bool Code(BitCoder& coder, bool bit) {
    constexpr int kFastest = 2;
    constexpr int kSlowest = 20;
    bit = coder.Code(bit, likely_);
    const int rate = kFastest + seen_;
    likely_ += ((bit ? kCertain - kLeast : kLeast) - likely_) / rate;
    if (rate < kSlowest) ++seen_;
    return bit;
  }

 private:
  static constexpr int kLeast = kCertain / 256;
  int likely_ = kCertain / 2;
  int seen_ = 0;
};

// This codes numbers of `kBits` bits, some of which are more frequent than others.
template <int kBits>
class LearntSymbol {
 public:
  std::uint32_t Code(BitCoder& coder, std::uint32_t symbol) {
    std::uint32_t node = 1;
    for (int i = kBits - 1; i >= 0; --i) {
      const bool bit = (symbol >> static_cast<unsigned>(i) & 1U) != 0;
      node = node << 1U | static_cast<std::uint32_t>(nodes_[node].Code(coder, bit));
    }
    return node - (1U << kBits);
  }

 private:
  std::array<LearntBit, 1U << kBits> nodes_;
};

// This codes numbers about 0, up to +-(2^kLongest - 1). It learns their number of digits, their
// sign, and the digit after the first.
class LearntNumber {
 public:
  static constexpr int kLongest = 24;

  std::int32_t Code(BitCoder& coder, std::int32_t number) {
    const auto size = static_cast<std::uint32_t>(number < 0 ? -number : number);
    const int digits = std::bit_width(size);
    int read = 0;
    while (read < kLongest &&
           longer_.at(static_cast<std::size_t>(read)).Code(coder, read < digits)) {
      ++read;
    }
    if (read == 0) return 0;
    const bool negative = negative_.Code(coder, number < 0);
    std::uint32_t coded = 1;
    if (read > 1) {
      const bool second = (size >> static_cast<unsigned>(read - 2) & 1U) != 0;
      const bool bit = second_.at(static_cast<std::size_t>(read)).Code(coder, second);
      const std::uint32_t rest = coder.CodePlain(size, read - 2);
      coded = (2U | static_cast<std::uint32_t>(bit)) << static_cast<unsigned>(read - 2) | rest;
    }
    const auto magnitude = static_cast<std::int32_t>(coded);
    return negative ? -magnitude : magnitude;
  }

 private:
  std::array<LearntBit, kLongest> longer_;
  std::array<LearntBit, kLongest + 1> second_;
  LearntBit negative_;
};

}  // namespace trailcast::route
