#include "services/route/src/bit_coder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace trailcast::route {
namespace {

struct Bit {
  bool set;
  int likely;
};

// These bits are as probable as they are said to be.
std::vector<Bit> SomeBits(std::size_t count, std::mt19937& random) {
  std::vector<Bit> bits;
  for (std::size_t i = 0; i < count; ++i) {
    const int likely = 1 + static_cast<int>(random() % (kCertain - 1));
    bits.push_back({static_cast<int>(random() % kCertain) < likely, likely});
  }
  return bits;
}

std::string Written(const std::vector<Bit>& bits) {
  BitCoder writer;
  for (const Bit& bit : bits) writer.Code(bit.set, bit.likely);
  return writer.Finish();
}

TEST(BitCoder, BitsComeBackHoweverProbableTheyWere) {
  std::mt19937 random(1);
  for (std::size_t count = 0; count < 300; ++count) {
    const std::vector<Bit> bits = SomeBits(count, random);
    const std::string bytes = Written(bits);
    BitCoder reader(bytes);
    for (const Bit& bit : bits) ASSERT_EQ(reader.Code(!bit.set, bit.likely), bit.set);
    EXPECT_TRUE(reader.AtEnd()) << count;
  }
}

TEST(BitCoder, TheImprobableComesBackAsWell) {
  const std::vector<Bit> bits(2000, Bit{true, 1});
  const std::string bytes = Written(bits);
  EXPECT_NEAR(static_cast<double>(bytes.size()), 2000 * 16 / 8.0, 20.0);
  BitCoder reader(bytes);
  for (std::size_t i = 0; i < bits.size(); ++i) ASSERT_TRUE(reader.Code(false, 1));
}

TEST(BitCoder, BitsTakeWhatTheirProbabilityAllows) {
  std::mt19937 random(2);
  const std::vector<Bit> bits = SomeBits(20'000, random);
  double information = 0.0;
  for (const Bit& bit : bits) {
    const double likely = bit.likely / static_cast<double>(kCertain);
    information -= std::log2(bit.set ? likely : 1.0 - likely);
  }
  EXPECT_NEAR(static_cast<double>(Written(bits).size()), information / 8.0, information / 800.0);
}

TEST(BitCoder, WhoReadsBeyondTheEndIsTold) {
  BitCoder writer;
  writer.CodePlain(0xabcdU, 16);
  const std::string bytes = writer.Finish();
  BitCoder reader(bytes);
  EXPECT_EQ(reader.CodePlain(0, 16), 0xabcdU);
  EXPECT_FALSE(reader.exhausted());
  for (int i = 0; i < 5; ++i) reader.CodePlain(0, 8);
  EXPECT_TRUE(reader.exhausted());
  EXPECT_FALSE(reader.AtEnd());
}

TEST(BitCoder, BytesThatWereNotReadAreSeen) {
  BitCoder writer;
  writer.CodePlain(0xabcdU, 16);
  const std::string bytes = writer.Finish() + "and more of them";
  BitCoder reader(bytes);
  reader.CodePlain(0, 16);
  EXPECT_FALSE(reader.AtEnd());
}

TEST(BitCoder, TheLogisticFunctionRisesAndIsNeverCertain) {
  int last = 1;
  for (int z = -20'000; z <= 20'000; ++z) {
    const int value = Logistic(z);
    ASSERT_GE(value, last);
    ASSERT_LT(value, kCertain);
    ASSERT_EQ(value + Logistic(-z), kCertain);
    EXPECT_NEAR(value / 65536.0, 1.0 / (1.0 + std::exp(-z / 256.0)), 0.004);
    last = value;
  }
}

}  // namespace
}  // namespace trailcast::route
