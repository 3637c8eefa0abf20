#include "services/base/hex.h"

#include <gtest/gtest.h>

#include <vector>

namespace trailcast {
namespace {

TEST(ToHex, WritesTwoDigitsForEachByte) {
  EXPECT_EQ(ToHex({}), "");
  EXPECT_EQ(ToHex(std::vector<std::uint8_t>{0x00, 0x0F, 0xA5, 0xFF}), "000fa5ff");
}

TEST(IsHex, TakesLowerCaseDigitsAlone) {
  EXPECT_TRUE(IsHex(""));
  EXPECT_TRUE(IsHex("0123456789abcdef"));
  for (const char* other : {"A", "g", "0x1", "a b", "-1"}) EXPECT_FALSE(IsHex(other)) << other;
}

}  // namespace
}  // namespace trailcast
