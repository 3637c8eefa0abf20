#include "services/base/result.h"

#include <gtest/gtest.h>

namespace trailcast {
namespace {

Result<int> Half(int number) {
  if (number % 2 != 0) {
    return Fail(ErrorCode::kInvalidArgument, "{} is odd, expected an even number", number);
  }
  return number / 2;
}

Result<int> Quarter(int number) {
  const Result<int> half = Half(number);
  if (!half) return Wrap(half.error(), "halving");
  Result<int> quarter = Half(*half);
  if (!quarter) return Wrap(quarter.error(), "halving again");
  return quarter;
}

TEST(Result, CarriesTheValue) { EXPECT_EQ(Quarter(12).value(), 3); }

TEST(Fail, FormatsTheMessageAndKeepsTheCode) {
  const Result<int> half = Half(3);
  ASSERT_FALSE(half);
  EXPECT_EQ(half.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(half.error().message, "3 is odd, expected an even number");
}

TEST(Wrap, PutsWhatWasBeingDoneBeforeAndKeepsTheCode) {
  const Result<int> quarter = Quarter(6);
  ASSERT_FALSE(quarter);
  EXPECT_EQ(quarter.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(quarter.error().message, "halving again: 3 is odd, expected an even number");
}

}  // namespace
}  // namespace trailcast
