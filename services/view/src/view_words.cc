#include "services/view/src/view_words.h"

#include <bit>

namespace trailcast::view {
namespace {

constexpr int kMostCheckFlips = 4;

// These of a descriptor's 256 bits are used: the even ones of this list make its word in the first
// table, the odd ones in the second. They were chosen one after the other over simulated views, for
// being little correlated with those before and seldom different when a feature is seen again.
constexpr std::array<std::uint8_t, kTables* kWordBits> kBits = {
    209, 208, 44, 200, 83, 148, 93, 46, 68,  189, 15, 38,  238, 233, 254, 149, 253, 25,  210, 107,
    50,  75,  17, 32,  62, 64,  80, 21, 159, 167, 3,  252, 183, 26,  207, 123, 88,  165, 139, 69};

}  // namespace

std::array<Where, kTables> WhereIs(const route::Descriptor& descriptor) {
  std::array<Where, kTables> where{};
  for (std::size_t i = 0; i < kBits.size(); ++i) {
    const unsigned bit = kBits[i];
    std::uint32_t& word = where[i % kTables].word;
    word = word << 1U | (static_cast<unsigned>(descriptor[bit / 8]) >> (bit % 8) & 1U);
  }
  for (std::size_t table = 0; table < kTables; ++table) {
    where[table].check = where[kTables - 1 - table].word >> (kWordBits - kCheckBits);
  }
  return where;
}

const std::vector<std::uint32_t>& Flips() {
  static const std::vector<std::uint32_t> flips = [] {
    std::vector<std::uint32_t> all{0};
    for (unsigned a = 0; a < kWordBits; ++a) all.push_back(1U << a);
    for (unsigned a = 0; a < kWordBits; ++a) {
      for (unsigned b = 0; b < a; ++b) all.push_back(1U << a | 1U << b);
    }
    return all;
  }();
  return flips;
}

const std::array<bool, kCheckMask + 1>& FewFlips() {
  static const auto few = [] {
    std::array<bool, kCheckMask + 1> made{};
    for (std::uint32_t flips = 0; flips <= kCheckMask; ++flips) {
      made[flips] = std::popcount(flips) <= kMostCheckFlips;
    }
    return made;
  }();
  return few;
}

}  // namespace trailcast::view
