#include "services/base/told_lately.h"

#include <gtest/gtest.h>

namespace trailcast {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kAgain{100};
constexpr ToldLately::Time kStart{};

TEST(ToldLately, TheSameIsDueOnceAndAgainAfterAWhile) {
  ToldLately told(kAgain);
  EXPECT_TRUE(told.IsDue("a full disk", kStart));
  EXPECT_FALSE(told.IsDue("a full disk", kStart + kAgain - milliseconds(1)));
  EXPECT_TRUE(told.IsDue("another", kStart + kAgain - milliseconds(1)));
  EXPECT_TRUE(told.IsDue("a full disk", kStart + kAgain));
  EXPECT_FALSE(told.IsDue("a full disk", kStart + kAgain + milliseconds(1)));
}

TEST(ToldLately, OfTooManyNoneIsRemembered) {
  ToldLately told(kAgain);
  ASSERT_TRUE(told.IsDue("first", kStart));
  for (std::size_t i = 1; i < ToldLately::kMost; ++i) {
    ASSERT_TRUE(told.IsDue(std::to_string(i), kStart));
  }
  EXPECT_TRUE(told.IsDue("first", kStart));
}

}  // namespace
}  // namespace trailcast
