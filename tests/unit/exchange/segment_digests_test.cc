#include "services/exchange/segment_digests.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace trailcast::exchange {
namespace {

route::Digest DigestNumber(unsigned number) {
  route::Digest digest{};
  digest[0] = static_cast<std::uint8_t>(number);
  digest[1] = static_cast<std::uint8_t>(number >> 8U);
  return digest;
}

TEST(SegmentDigests, HoldsWhatAMapWouldInWhateverOrderItComes) {
  SegmentDigests digests;
  std::map<SegmentIndex, route::Digest> expected;
  std::mt19937 random(3);
  for (unsigned step = 0; step < 2000; ++step) {
    const SegmentIndex index(static_cast<std::uint32_t>(random() % 100));
    if (random() % 3 == 0) {
      const auto known = expected.find(index);
      const auto removed = digests.Remove(index);
      ASSERT_EQ(removed.has_value(), known != expected.end());
      if (!removed) continue;
      EXPECT_EQ(*removed, known->second);
      expected.erase(known);
    } else {
      digests.Put(index, DigestNumber(step));
      expected[index] = DigestNumber(step);
    }
  }
  ASSERT_EQ(digests.entries().size(), expected.size());
  auto at = digests.entries().begin();
  for (const auto& [index, digest] : expected) {
    EXPECT_EQ(at->index, index);
    EXPECT_EQ(at->digest, digest);
    ASSERT_NE(digests.Find(index), nullptr);
    EXPECT_EQ(*digests.Find(index), digest);
    ++at;
  }
  EXPECT_EQ(digests.contains(SegmentIndex(100)), false);
  EXPECT_EQ(digests.From(SegmentIndex(100)), digests.entries().end());
  digests.clear();
  EXPECT_TRUE(digests.empty());
}

}  // namespace
}  // namespace trailcast::exchange
