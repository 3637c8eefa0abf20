#include "services/mission/driver_seat.h"

#include <gtest/gtest.h>

namespace trailcast::mission {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using Verdict = DriverSeat::Verdict;

class DriverSeatTest : public testing::Test {
 protected:
  // A word of a driver whose clock began `clock` before ours, said now and heard `under_way` later.
  Verdict Say(const std::string& driver, milliseconds under_way = milliseconds(5),
              milliseconds clock = milliseconds(77'000)) {
    const auto said = now_.time_since_epoch() + clock;
    now_ += under_way;
    return seat_.Hear(
        driver, static_cast<std::uint64_t>(std::chrono::duration_cast<milliseconds>(said).count()),
        now_);
  }
  DriverSeat seat_;
  DriverSeat::Time now_{hours(100)};
};

TEST_F(DriverSeatTest, AWordIsGoodForAMomentAndNobodyHoldsItBefore) {
  EXPECT_FALSE(seat_.Holds(now_));
  EXPECT_EQ(Say("ann"), Verdict::kGood);
  EXPECT_TRUE(seat_.Holds(now_ + milliseconds(299)));
  EXPECT_FALSE(seat_.Holds(now_ + milliseconds(300)));
  EXPECT_TRUE(seat_.IsTaken(now_ + milliseconds(999)));
  EXPECT_FALSE(seat_.IsTaken(now_ + milliseconds(1000)));
}

TEST_F(DriverSeatTest, WhatWasUnderWayForLongerIsGoodForLessOrNotAtAll) {
  EXPECT_EQ(Say("ann"), Verdict::kGood);
  EXPECT_EQ(Say("ann", milliseconds(205)), Verdict::kGood);
  EXPECT_EQ(seat_.late(), milliseconds(199));  // less what the clocks may have drifted apart
  EXPECT_TRUE(seat_.Holds(now_ + milliseconds(100)));
  EXPECT_FALSE(seat_.Holds(now_ + milliseconds(101)));
  EXPECT_EQ(Say("ann", milliseconds(400)), Verdict::kLate);
  EXPECT_FALSE(seat_.Holds(now_));
  EXPECT_EQ(Say("ann"), Verdict::kGood);
}

TEST_F(DriverSeatTest, WhatWasOvertakenIsLate) {
  EXPECT_EQ(seat_.Hear("ann", 1000, now_), Verdict::kGood);
  EXPECT_EQ(seat_.Hear("ann", 900, now_ + milliseconds(1)), Verdict::kLate);
  EXPECT_EQ(seat_.Hear("ann", 1000, now_ + milliseconds(2)), Verdict::kGood);
}

TEST_F(DriverSeatTest, OfTwoTheFirstDrivesUntilThatIsSilent) {
  EXPECT_EQ(Say("ann"), Verdict::kGood);
  EXPECT_EQ(Say("bob"), Verdict::kTaken);
  now_ += milliseconds(800);
  EXPECT_EQ(Say("ann"), Verdict::kGood);
  now_ += milliseconds(990);
  EXPECT_EQ(Say("bob"), Verdict::kTaken);
  now_ += milliseconds(10);
  EXPECT_EQ(Say("bob", milliseconds(5), milliseconds(-3'000)), Verdict::kGood);
  EXPECT_EQ(Say("ann"), Verdict::kTaken);
}

TEST_F(DriverSeatTest, ClocksMayDriftAndBeginAnew) {
  // A clock that loses 0.1 ms a second would make all late in an hour.
  milliseconds clock(0);
  for (int s = 0; s < 8000; ++s) {
    now_ += milliseconds(995);
    if (s % 10 == 0) --clock;
    ASSERT_EQ(Say("ann", milliseconds(5), clock), Verdict::kGood) << s;
    ASSERT_LT(seat_.late(), milliseconds(10)) << s;
  }
  EXPECT_EQ(Say("ann", milliseconds(5), -hours(50)), Verdict::kGood);
}

TEST_F(DriverSeatTest, AnyClockIsOne) {
  EXPECT_EQ(seat_.Hear("ann", 0, now_), Verdict::kGood);
  EXPECT_EQ(seat_.Hear("ann", ~0ULL, now_), Verdict::kGood);
  EXPECT_EQ(seat_.Hear("ann", 1ULL << 63U, now_), Verdict::kGood);
}

}  // namespace
}  // namespace trailcast::mission
