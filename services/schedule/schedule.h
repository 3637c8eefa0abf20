#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"

namespace trailcast::schedule {

// So many robots are named in one schedule, and so many times of a day.
inline constexpr std::size_t kMostRobots = 16;
inline constexpr std::size_t kMostTimes = 48;
// The names of the missions are made of a schedule's name and a time.
inline constexpr std::size_t kMostNameBytes = 48;

inline constexpr int kMinutesADay = 24 * 60;

// This says how times are treated that have passed while no server was there.
enum class Missed : std::uint8_t {
  kSkip,  // they are left out
  kOnce,  // one mission is sent for all of them
};

struct Date {
  int year = 0;
  int month = 0;
  int day = 0;
  bool operator==(const Date&) const = default;
};

// A mission that is sent to robots again and again, or once. Its words are one line:
//   NAME to ROBOT[,ROBOT ..]
//     at HH:MM[,HH:MM ..] [on DAYS]
//       or every MINUTES [from HH:MM until HH:MM] [on DAYS]
//       or once YYYY-MM-DD HH:MM
//     zone ZONE [battery PERCENT] [unless-closed] [if-arrived] [missed skip|once] [valid SECONDS]
//     [goes-on] do ORDERS
// ROBOT is a name, or the beginning of names with '*' behind it: all robots of such names that the
// server hears then. DAYS are "mon", "tue", .. or "mon-fri", with commas between them. A period
// that ends before it begins ends on the next day, and its day is the one on which it begins. ZONE
// is a name of the IANA time zone database. ORDERS are those of a mission, or "goto PLACE" with the
// photos on the way there, if there are any, behind it.
struct Schedule {
  std::string name{};
  std::vector<std::string> robots{};
  // Minutes after midnight. They are empty with `every_min`; with `once`, there is one.
  std::vector<int> at_min{};
  int every_min = 0;  // counted from the beginning of the period; 0 with `at_min`
  int from_min = 0;
  int until_min = kMinutesADay;
  std::set<int> days{};        // 0 is Monday; empty means every day
  std::optional<Date> once{};  // that day alone
  std::string zone{};
  std::optional<int> battery_percent{};  // a robot with less is not sent
  bool unless_closed = false;            // none is sent while a route of the orders is closed there
  bool if_arrived = false;               // a robot is not sent if its last mission did not arrive
  Missed missed = Missed::kSkip;
  std::uint32_t valid_s = 600;  // see mission::Mission::valid_for_s
  bool goes_on = false;         // likewise
  std::string orders{};
  bool operator==(const Schedule&) const = default;
};

// Fails with kInvalidArgument, which says what was wrong and what was expected, also for a time
// zone, a time or a day that does not exist.
[[nodiscard]] Result<Schedule> ParseSchedule(std::string_view words);
// Returns words as ParseSchedule takes them, without default values.
[[nodiscard]] std::string ToText(const Schedule& schedule);
// Returns when it is due: "at 08:30 on mon-fri zone Europe/Berlin".
[[nodiscard]] std::string WhenText(const Schedule& schedule);

// Returns the orders as a robot's mission has them.
[[nodiscard]] std::string MissionOrders(const Schedule& schedule);
// Returns the orders of a schedule whose missions have these, which is the opposite.
[[nodiscard]] std::string ScheduleOrders(std::string mission_orders);
// Returns the mission's name, which is the same at whichever server and however often it is sent:
// "night-round-20261130T0730Z".
[[nodiscard]] std::string MissionId(const Schedule& schedule, std::int64_t due_unix_ms);
// Says whether a robot is among those that a word of Schedule::robots means.
[[nodiscard]] bool IsMeant(std::string_view word, std::string_view robot);
[[nodiscard]] bool IsPattern(std::string_view word);

// These return times at which the schedule is due, in milliseconds since 1970. They know no clock.
//
// Where clocks are set forward, a time that they skip is the moment at which they are set. Where
// they are set back, a time that comes twice is the first of the two; a period lasts until the
// second one. `every_min` are minutes that pass, however clocks are set.
//
// Returns the first after a moment, or nothing if there is none or the time zone is no longer
// known.
[[nodiscard]] std::optional<std::int64_t> NextDue(const Schedule& schedule,
                                                  std::int64_t after_unix_ms);
// Returns the last one after a moment, until another, inclusive.
[[nodiscard]] std::optional<std::int64_t> LastDue(const Schedule& schedule,
                                                  std::int64_t after_unix_ms,
                                                  std::int64_t until_unix_ms);

// Returns the first times after a moment, until another, inclusive.
[[nodiscard]] std::vector<std::int64_t> Upcoming(const Schedule& schedule,
                                                 std::int64_t after_unix_ms,
                                                 std::int64_t until_unix_ms, std::size_t most);
[[nodiscard]] std::string ClockText(int minutes);  // "08:30" of minutes after midnight
[[nodiscard]] std::string DayText(int day);        // "mon" of 0

// Fails with kInvalidArgument if the database has no such time zone.
[[nodiscard]] Result<void> CheckZone(const std::string& zone);
[[nodiscard]] Result<void> CheckDate(const Date& date);
// Returns "Mon 2026-11-30 08:30 CET", or UTC if the time zone is not known here.
[[nodiscard]] std::string TextIn(const std::string& zone, std::int64_t unix_ms);

}  // namespace trailcast::schedule
