#include "services/base/unix_time.h"

#include <gtest/gtest.h>

#include <limits>

namespace trailcast {
namespace {

TEST(DateText, IsOfTheMinuteInUtc) {
  EXPECT_EQ(DateText(86'400'000), "1970-01-02 00:00 UTC");
  EXPECT_EQ(DateText(1'795'498'259'999), "2026-11-24 05:30 UTC");
}

TEST(DateText, OfWhatIsNoDateIsUnknown) {
  EXPECT_EQ(DateText(0), "at an unknown time");
  EXPECT_EQ(DateText(-1), "at an unknown time");
  EXPECT_EQ(DateText(std::numeric_limits<std::int64_t>::max()), "at an unknown time");
}

TEST(MomentText, IsOfTheSecondInUtc) {
  EXPECT_EQ(MomentText(86'400'999), "on 1970-01-02 at 00:00:00 UTC");
  EXPECT_EQ(MomentText(1'795'498'259'999), "on 2026-11-24 at 05:30:59 UTC");
  EXPECT_EQ(MomentText(-1), "at an unknown time");
}

TEST(Age, IsGivenInAUnitThatFits) {
  EXPECT_EQ(Age(-5), "0 s");
  EXPECT_EQ(Age(119'000), "119 s");
  EXPECT_EQ(Age(3LL * 3'600'000), "3 h");
  EXPECT_EQ(Age(50LL * 3'600'000), "2 d");
}

}  // namespace
}  // namespace trailcast
