#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/schedule/listed.h"
#include "services/schedule/schedule.h"

namespace trailcast::schedule {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string Refusal(const std::string& words) {
  const auto schedule = ParseSchedule(words);
  return schedule ? "" : schedule.error().message;
}

TEST(ScheduleWords, AreTheSameScheduleAgain) {
  for (const std::string words :
       {"night-round to robot1,cart-* at 02:00,22:00 on mon-fri zone Europe/Berlin battery 40 "
        "unless-closed if-arrived missed once valid 60 goes-on do follow hall 3..10 laps 2 wait 5",
        "shuttle to cart-* every 20 from 22:00 until 06:00 on mon,tue,sat zone UTC do goto dock",
        "look to cart-1 at 08:30 zone UTC do goto dock photo every 5 at boiler=hall@12.5",
        "round to cart-1 at 08:30 zone UTC do photo every 5 follow hall",
        "audit to robot1 once 2026-12-24 08:30 zone UTC do follow hall"}) {
    const auto schedule = ParseSchedule(words);
    ASSERT_TRUE(schedule) << schedule.error().message;
    EXPECT_EQ(ToText(*schedule), words);
  }
}

TEST(ScheduleWords, MeanDays) {
  const auto days = [](const std::string& words) {
    const auto schedule = ParseSchedule("s to r at 08:00 on " + words + " zone UTC do follow hall");
    return schedule ? schedule->days : std::set<int>{99};
  };
  EXPECT_THAT(days("mon-fri"), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(days("sat-mon"), ElementsAre(0, 5, 6)) << "over the end of the week";
  EXPECT_THAT(days("sun,wed,sun"), ElementsAre(2, 6));
  EXPECT_THAT(days("mon-sun"), IsEmpty()) << "every day";
}

TEST(ScheduleWords, ThatAreWrongAreNamedWithWhatWasExpected) {
  const std::string end = " zone UTC do follow hall";
  const struct {
    std::string words;
    std::string said;
  } kWrong[] = {
      {"s to r at 25:00" + end, "'25:00' in a schedule: expected a time from 00:00 to 23:59"},
      {"s to r at 24:00" + end, "'24:00'"},
      {"s to r at 8:30" + end, "'8:30'"},
      {"s to r at 08:30," + end, "expected a time"},
      {"s to r once 2026-02-31 08:00" + end,
       "2026-02-31 does not exist: February 2026 has 28 days"},
      {"s to r once 2027-02-29 08:00" + end, "February 2027 has 28 days"},
      {"s to r once 2026-13-01 08:00" + end, "2026-13-01 is no day"},
      {"s to r once tomorrow 08:00" + end, "'tomorrow' in a schedule: expected a day"},
      {"s to r once 2026-12-24" + end, "expected a time"},
      {"s to r at 08:30 zone Europe/Hamburg do follow hall", "no time zone 'Europe/Hamburg'"},
      {"s to r at 08:30 do follow hall", "say 'zone ZONE'"},
      {"s at 08:30" + end, "there is nobody to send to"},
      {"s to r,,q at 08:30" + end, "expected a robot's name"},
      {"s to r*x at 08:30" + end, "'r*x'"},
      {"s to r at 08:30 on holidays" + end, "expected days"},
      {"s to r every 0" + end, "expected minutes, 1 to 1440"},
      {"s to r every 20 from 08:00" + end, "'from' and 'until' go together"},
      {"s to r every 20 from 08:00 until 08:00" + end, "ends when it begins"},
      {"s to r at 08:30 from 08:00 until 09:00" + end, "for 'every' alone"},
      {"s to r at 08:30 every 20" + end, "expected one of"},
      {"s to r" + end, "expected one of"},
      {"s to r at 08:30 at 09:30" + end, "'at' in a schedule: expected it once"},
      {"s to r once 2026-12-24 08:30 on mon" + end, "leave 'on' out"},
      {"s to r at 08:30 battery 101" + end, "1 to 100"},
      {"s to r at 08:30 missed twice" + end, "'skip' or 'once'"},
      {"s to r at 08:30 someday" + end, "'someday'"},
      {"s to r at 08:30 zone UTC", "say what is to be done"},
      {"s to r at 08:30 zone UTC do dance", "dance"},
      {"s to r at 08:30 zone UTC do goto office@8 now", "one place and nothing else"},
      {"s to r at 08:30 zone UTC do goto office@8 photo", "nothing else but photos"},
      {"s to r at 08:30 zone UTC do goto office@8 photo every 5 follow hall", "but photos"},
      {"s to r at 08:30 zone UTC do goto office@8 way 2", "but photos"},
      {"s to r at 08:30 zone UTC do goto office@8 because I say so", "but photos"},
      {"s to r at 08:30 zone UTC do teach yard", "no 'teach'"},
      {"a/b to r at 08:30" + end, "'a/b' in a schedule: expected its name"},
      {std::string(49, 's') + " to r at 08:30" + end, "expected its name: 1 to 48"},
  };
  for (const auto& [words, said] : kWrong) {
    EXPECT_THAT(Refusal(words), HasSubstr(said)) << words;
  }
}

TEST(ScheduleWords, AGoalIsPlannedWhenItsRobotIsAboutToBegin) {
  const auto schedule = ParseSchedule("s to r at 08:30 zone UTC do goto office@8");
  ASSERT_TRUE(schedule) << schedule.error().message;
  EXPECT_EQ(MissionOrders(*schedule), "goto office@8 wait way");
  EXPECT_EQ(ScheduleOrders("goto office@8 wait way"), "goto office@8");
  EXPECT_EQ(ScheduleOrders("follow hall"), "follow hall");
}

TEST(ScheduleWords, APatternMeansAllNamesThatBeginSo) {
  EXPECT_TRUE(IsMeant("cart-*", "cart-12"));
  EXPECT_FALSE(IsMeant("cart-*", "car"));
  EXPECT_TRUE(IsMeant("cart-1", "cart-1"));
  EXPECT_FALSE(IsMeant("cart-1", "cart-12"));
}

TEST(ScheduleWords, EditsAreForOneServer) {
  const std::string words = "schedule server1 pause night-round";
  EXPECT_EQ(ServerOf(words), "server1");
  const auto edit = ParseScheduleEdit(words);
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(ToText(*edit), words);
  EXPECT_FALSE(IsEdit("close hall"));
  EXPECT_FALSE(ParseScheduleEdit("schedule server1"));
  EXPECT_FALSE(ParseScheduleEdit("schedule server1 add"));
  EXPECT_FALSE(ParseScheduleEdit("schedule server1 remove"));
  EXPECT_FALSE(ParseScheduleEdit("schedule server1 burn night-round"));
}

TEST(ScheduleWords, OfWhatAServerListsAreUnderstoodAndOthersLeftOut) {
  const auto schedule = ParseSchedule("s to r,q at 08:30 zone UTC do follow hall");
  ASSERT_TRUE(schedule);
  const Listed listed{.schedule = *schedule,
                      .by = "desk",
                      .paused_by = "boss",
                      .next_unix_ms = std::nullopt,
                      .last_unix_ms = 1000,
                      .outcome = "hall 3..7 is closed",
                      .sent = {{"r", "s-1", "arrived"}, {"q", "", "not sent: its battery is low"}}};
  std::vector<std::string> lines = LinesOf(listed);
  lines.insert(lines.begin() + 1, "mood s cheerful");
  lines.insert(lines.begin(), "due other - - -");
  lines.push_back("schedule of nothing");
  EXPECT_THAT(ParseLines(lines), ElementsAre(listed));
}

}  // namespace
}  // namespace trailcast::schedule
