#include "services/base/hex.h"

#include <gtest/gtest.h>

#include <vector>

namespace trailcast {
namespace {

TEST(ToHex, WritesTwoDigitsForEachByte) {
  EXPECT_EQ(ToHex({}), "");
  EXPECT_EQ(ToHex(std::vector<std::uint8_t>{0x00, 0x0F, 0xA5, 0xFF}), "000fa5ff");
}

}  // namespace
}  // namespace trailcast
