#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "services/schedule/schedule.h"

namespace trailcast::schedule {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kMinute_ms = 60'000;
constexpr std::int64_t kDay_ms = 24 * 60 * kMinute_ms;

std::int64_t Utc(int year, unsigned month, unsigned day, int hour = 0, int minute = 0) {
  const std::chrono::sys_days days{std::chrono::year{year} / std::chrono::month{month} /
                                   std::chrono::day{day}};
  return days.time_since_epoch().count() * kDay_ms + (60 * hour + minute) * kMinute_ms;
}

Schedule For(const std::string& when) {
  auto schedule = ParseSchedule("s to robot1 " + when + " do follow hall");
  EXPECT_TRUE(schedule) << when << ": " << schedule.error().message;
  return schedule ? *schedule : Schedule{};
}

// Returns when it is due, in its own time zone.
std::vector<std::string> Due(const std::string& when, std::int64_t after, std::int64_t until) {
  const Schedule schedule = For(when);
  std::vector<std::string> due;
  while (true) {
    const auto next = NextDue(schedule, after);
    if (!next || *next > until) return due;
    EXPECT_GT(*next, after);
    // The last one until then is the same, and so is the last one until just before the one after.
    EXPECT_EQ(LastDue(schedule, after, *next), next);
    const auto other = NextDue(schedule, *next);
    EXPECT_EQ(LastDue(schedule, after, other.value_or(*next + 1) - 1), next);
    EXPECT_EQ(LastDue(schedule, after, *next - 1), std::nullopt);
    due.push_back(TextIn(schedule.zone, *next));
    after = *next;
  }
}

TEST(ScheduleDue, IsAtTimesOnDaysOfTheWeek) {
  // 2026-11-27 is a Friday.
  EXPECT_THAT(Due("at 12:00,08:30 on mon-fri zone Europe/Berlin", Utc(2026, 11, 27, 8),
                  Utc(2026, 11, 30, 12)),
              ElementsAre("Fri 2026-11-27 12:00 CET", "Mon 2026-11-30 08:30 CET",
                          "Mon 2026-11-30 12:00 CET"));
}

TEST(ScheduleDue, IsOnceOnItsDayAlone) {
  EXPECT_THAT(Due("once 2028-02-29 23:59 zone UTC", Utc(2026, 1, 1), Utc(2030, 1, 1)),
              ElementsAre("Tue 2028-02-29 23:59 UTC"));
  EXPECT_EQ(NextDue(For("once 2020-01-01 00:00 zone UTC"), Utc(2026, 1, 1)), std::nullopt);
}

TEST(ScheduleDue, IsEverySoOftenFromTheBeginningOfItsPeriod) {
  EXPECT_THAT(
      Due("every 25 from 08:00 until 09:00 on sat zone UTC", Utc(2026, 11, 27), Utc(2026, 11, 30)),
      ElementsAre("Sat 2026-11-28 08:00 UTC", "Sat 2026-11-28 08:25 UTC",
                  "Sat 2026-11-28 08:50 UTC"));
  EXPECT_THAT(
      Due("every 30 from 08:00 until 09:00 zone UTC", Utc(2026, 11, 28, 8), Utc(2026, 11, 28, 20)),
      ElementsAre("Sat 2026-11-28 08:30 UTC", "Sat 2026-11-28 09:00 UTC"))
      << "its end is included";
}

TEST(ScheduleDue, IsOnThroughTheNightOfTheDayOnWhichItsPeriodBegins) {
  EXPECT_THAT(
      Due("every 120 from 22:00 until 03:00 on fri zone UTC", Utc(2026, 11, 26), Utc(2026, 12, 3)),
      ElementsAre("Fri 2026-11-27 22:00 UTC", "Sat 2026-11-28 00:00 UTC",
                  "Sat 2026-11-28 02:00 UTC"));
}

TEST(ScheduleDue, CountsAnewFromEachMidnight) {
  EXPECT_THAT(Due("every 700 zone UTC", Utc(2026, 11, 27) - 1, Utc(2026, 11, 28, 12)),
              ElementsAre("Fri 2026-11-27 00:00 UTC", "Fri 2026-11-27 11:40 UTC",
                          "Fri 2026-11-27 23:20 UTC", "Sat 2026-11-28 00:00 UTC",
                          "Sat 2026-11-28 11:40 UTC"));
  EXPECT_THAT(Due("every 720 on mon zone UTC", Utc(2026, 11, 29), Utc(2026, 12, 2)),
              ElementsAre("Mon 2026-11-30 00:00 UTC", "Mon 2026-11-30 12:00 UTC"))
      << "midnight belongs to the next day";
}

// On 2026-03-29 clocks in Berlin are set from 02:00 to 03:00, which is 01:00 UTC.
TEST(ScheduleDue, WhereClocksAreSetForwardIsAtThatMomentForTimesThatTheySkip) {
  EXPECT_THAT(Due("at 02:30 zone Europe/Berlin", Utc(2026, 3, 27, 12), Utc(2026, 3, 30, 12)),
              ElementsAre("Sat 2026-03-28 02:30 CET", "Sun 2026-03-29 03:00 CEST",
                          "Mon 2026-03-30 02:30 CEST"));
  EXPECT_THAT(
      Due("at 02:10,02:50,03:00 zone Europe/Berlin", Utc(2026, 3, 28, 12), Utc(2026, 3, 29, 12)),
      ElementsAre("Sun 2026-03-29 03:00 CEST"))
      << "once, however many were skipped";
  EXPECT_THAT(Due("every 30 from 01:00 until 04:00 zone Europe/Berlin", Utc(2026, 3, 28, 12),
                  Utc(2026, 3, 29, 12)),
              ElementsAre("Sun 2026-03-29 01:00 CET", "Sun 2026-03-29 01:30 CET",
                          "Sun 2026-03-29 03:00 CEST", "Sun 2026-03-29 03:30 CEST",
                          "Sun 2026-03-29 04:00 CEST"));
}

// On 2026-10-25 clocks in Berlin are set from 03:00 to 02:00, which is 01:00 UTC.
TEST(ScheduleDue, WhereClocksAreSetBackIsAtTheFirstOfATimeThatComesTwice) {
  EXPECT_THAT(Due("at 02:30 zone Europe/Berlin", Utc(2026, 10, 24, 12), Utc(2026, 10, 26, 12)),
              ElementsAre("Sun 2026-10-25 02:30 CEST", "Mon 2026-10-26 02:30 CET"));
  EXPECT_THAT(Due("every 30 from 02:00 until 02:30 zone Europe/Berlin", Utc(2026, 10, 24, 12),
                  Utc(2026, 10, 25, 12)),
              ElementsAre("Sun 2026-10-25 02:00 CEST", "Sun 2026-10-25 02:30 CEST",
                          "Sun 2026-10-25 02:00 CET", "Sun 2026-10-25 02:30 CET"))
      << "minutes that pass, however clocks are set";
}

TEST(ScheduleDue, IsOnADayThatAPlaceLeftOut) {
  // Samoa went from the 29th to the 31st.
  EXPECT_THAT(Due("at 12:00 zone Pacific/Apia", Utc(2011, 12, 29), Utc(2011, 12, 31, 12)),
              ElementsAre("Thu 2011-12-29 12:00 -10", "Sat 2011-12-31 00:00 +14",
                          "Sat 2011-12-31 12:00 +14"));
}

TEST(ScheduleDue, IsTheLastOfManyThatHavePassed) {
  EXPECT_EQ(LastDue(For("every 1 zone UTC"), Utc(2020, 1, 1), Utc(2026, 11, 30, 7, 30) + 1),
            Utc(2026, 11, 30, 7, 30));
  EXPECT_EQ(LastDue(For("at 08:00 on thu zone UTC"), Utc(2026, 11, 1), Utc(2026, 11, 25)),
            Utc(2026, 11, 19, 8));
}

TEST(ScheduleDue, MissionsAreNamedAfterTheMomentWhateverTheZone) {
  EXPECT_EQ(MissionId(For("at 08:30 zone Europe/Berlin"), Utc(2026, 11, 30, 7, 30)),
            "s-20261130T0730Z");
}

TEST(ScheduleDue, ZonesAreThoseOfTheDatabaseAndNoFiles) {
  for (const char* zone : {"UTC", "Europe/Berlin", "America/Argentina/Buenos_Aires", "Etc/GMT+5"}) {
    EXPECT_TRUE(CheckZone(zone)) << zone;
  }
  for (const char* zone : {"", "Europe", "Europe/Hamburg", "/etc/localtime", "../../etc/passwd",
                           "localtime", "Fixed/UTC+01:00:00", "/usr/share/zoneinfo/UTC"}) {
    EXPECT_FALSE(CheckZone(zone)) << zone;
  }
}

}  // namespace
}  // namespace trailcast::schedule
