#include "services/base/number.h"

#include <gtest/gtest.h>

namespace trailcast {
namespace {

TEST(ParseNumberWithin, IsNothingBeyondItsBounds) {
  EXPECT_EQ(ParseNumberWithin("2.5", 2.5, 3.0), 2.5);
  EXPECT_EQ(ParseNumberWithin("3", 2.5, 3.0), 3.0);
  for (const char* text : {"2.4", "3.1", "nan", "inf", "2.6 ", ""}) {
    EXPECT_EQ(ParseNumberWithin(text, 2.5, 3.0), std::nullopt) << text;
  }
}

TEST(ParseRange, EitherEndMayBeLeftOut) {
  const auto range = ParseRange("3..10", 0.0, 100.0);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->from, 3.0);
  EXPECT_EQ(range->to, 10.0);
  EXPECT_EQ(ParseRange("3..", 0.0, 100.0)->to, std::nullopt);
  EXPECT_EQ(ParseRange("..10", 0.0, 100.0)->from, std::nullopt);
  EXPECT_TRUE(ParseRange("..", 0.0, 100.0));
}

TEST(ParseRange, IsNothingWhereANumberIsNoneOrBeyondItsBounds) {
  for (const char* text : {"", "3", "3.10", "x..10", "3..x", "3..101", "-1..3"}) {
    EXPECT_FALSE(ParseRange(text, 0.0, 100.0)) << text;
  }
}

}  // namespace
}  // namespace trailcast
