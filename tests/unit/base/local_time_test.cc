#include "services/base/local_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

namespace trailcast {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kMinute_ms = 60'000;
constexpr std::int64_t kHour_ms = 60 * kMinute_ms;
constexpr std::int64_t kDay_ms = 24 * kHour_ms;

// It is Thursday, 2026-11-26, 21:02 in Berlin, which is an hour ahead of UTC then.
class LocalTimeTest : public testing::Test {
 protected:
  static constexpr std::int64_t kMidnight = 1'795'647'600'000;
  static constexpr std::int64_t kNow = kMidnight + 21 * kHour_ms + 2 * kMinute_ms;

  void SetUp() override { SetZone("CET-1CEST,M3.5.0,M10.5.0/3"); }
  void TearDown() override { SetZone("UTC0"); }
  static void SetZone(const char* zone) {
    setenv("TZ", zone, 1);  // NOLINT(concurrency-mt-unsafe): the only thread
    tzset();
  }
  static std::int64_t Since(const std::string& text, std::int64_t now = kNow) {
    const auto since = ParseSince(text, now);
    EXPECT_TRUE(since) << since.error().message;
    return since.value_or(-1);
  }
  static std::string Wrong(const std::string& text) {
    const auto since = ParseSince(text, kNow);
    EXPECT_FALSE(since) << text;
    return since ? "" : since.error().message;
  }
};

TEST_F(LocalTimeTest, DaysBeginAtMidnightOfTheTerminal) {
  EXPECT_EQ(Since("today"), kMidnight);
  EXPECT_EQ(Since("yesterday"), kMidnight - kDay_ms);
  EXPECT_EQ(Since("thursday"), kMidnight);
  EXPECT_EQ(Since("monday"), kMidnight - 3 * kDay_ms);
  EXPECT_EQ(Since("friday"), kMidnight - 6 * kDay_ms);
  EXPECT_EQ(Since("2026-11-23"), kMidnight - 3 * kDay_ms);
}

TEST_F(LocalTimeTest, ADayOnWhichClocksWereSetBeginsAtMidnightToo) {
  constexpr std::int64_t kNoonAfter = 1'774'864'800'000;  // 2026-03-30 12:00, summer time
  EXPECT_EQ(LocalText(Since("yesterday", kNoonAfter)), "Sun 2026-03-29 00:00");
  EXPECT_EQ(kNoonAfter - Since("yesterday", kNoonAfter), 35 * kHour_ms);
}

TEST_F(LocalTimeTest, TimesAreTodaysOrYesterdays) {
  EXPECT_EQ(Since("09:15"), kMidnight + 9 * kHour_ms + 15 * kMinute_ms);
  EXPECT_EQ(Since("22:00"), kMidnight - 2 * kHour_ms);
  EXPECT_EQ(Since("2026-11-23T09:15"), kMidnight - 3 * kDay_ms + 9 * kHour_ms + 15 * kMinute_ms);
  EXPECT_EQ(Since("2026-11-23 09:15:30"), Since("2026-11-23T09:15") + 30'000);
}

TEST_F(LocalTimeTest, SpansEndNow) {
  EXPECT_EQ(Since("90min"), kNow - 90 * kMinute_ms);
  EXPECT_EQ(Since("12h"), kNow - 12 * kHour_ms);
  EXPECT_EQ(Since("2d"), kNow - 2 * kDay_ms);
  EXPECT_EQ(Since("1w"), kNow - 7 * kDay_ms);
  EXPECT_EQ(Since("1.5h"), kNow - 90 * kMinute_ms);
}

TEST_F(LocalTimeTest, WhatNobodyMeansIsRefusedWithWhatIsAccepted) {
  for (const char* const text :
       {"", "mon", "lately", "2026-02-30", "2026-13-01", "24:00", "9", "12:60", "-2d", "2 d", "d",
        "2026-11-23T", "2026-11-23Tnoon", "1969-12-31", "2026-11"}) {
    EXPECT_THAT(Wrong(text), HasSubstr("expected a day (monday")) << text;
  }
  EXPECT_THAT(Wrong("2027-01-01"), HasSubstr("is yet to come"));
}

TEST_F(LocalTimeTest, IsWrittenWithItsWeekday) {
  EXPECT_EQ(LocalText(kNow), "Thu 2026-11-26 21:02");
  SetZone("UTC0");
  EXPECT_EQ(LocalText(kNow), "Thu 2026-11-26 20:02");
  EXPECT_EQ(LocalText(-1), "at an unknown time");
}

}  // namespace
}  // namespace trailcast
