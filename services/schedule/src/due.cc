// This computes when schedules are due.
#include <cctz/civil_time.h>
#include <cctz/time_zone.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "services/schedule/schedule.h"

namespace trailcast::schedule {
namespace {

using cctz::civil_day;
using cctz::civil_minute;
using cctz::civil_second;

// A week, and a day for a period that began on the day before.
constexpr int kMostDaysToNext = 9;

constexpr bool IsOfZoneName(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '+' || c == '-' || c == '/';
}

// The library remembers each name that it was asked for, and takes a path for a name. It is only
// asked for zones that the database has.
bool IsInDatabase(const std::string& zone) {
  const bool is_name = !zone.empty() && zone.size() <= 64 && zone.front() != '/' &&
                       zone != "localtime" && std::all_of(zone.begin(), zone.end(), IsOfZoneName);
  if (!is_name) return false;
  const char* folder = std::getenv("TZDIR");
  std::error_code error;
  return std::filesystem::is_regular_file(
      std::filesystem::path(folder == nullptr ? "/usr/share/zoneinfo" : folder) / zone, error);
}

std::optional<cctz::time_zone> Load(const std::string& zone) {
  cctz::time_zone loaded;
  if (!IsInDatabase(zone) || !cctz::load_time_zone(zone, &loaded)) return std::nullopt;
  return loaded;
}

cctz::time_point<cctz::seconds> SecondAt(std::int64_t unix_ms) {
  return cctz::time_point<cctz::seconds>(
      std::chrono::floor<cctz::seconds>(std::chrono::milliseconds(unix_ms)));
}

enum class Which { kFirst, kSecond };

// Returns the moment at which clocks show a time, `which` of two if they show it twice. A time that
// they skip is the moment at which they are set forward.
std::int64_t MomentOf(const civil_second& shown, const cctz::time_zone& zone, Which which) {
  const auto found = zone.lookup(shown);
  const bool is_skipped = found.kind == cctz::time_zone::civil_lookup::SKIPPED;
  const auto moment = is_skipped ? found.trans : which == Which::kFirst ? found.pre : found.post;
  return 1000 * static_cast<std::int64_t>(moment.time_since_epoch().count());
}

// The moments begin, begin + step, .. up to `end`, inclusive.
struct Moments {
  std::int64_t begin = 0;
  std::int64_t end = 0;
  std::int64_t step = 0;  // 0 for `begin` alone

  [[nodiscard]] std::optional<std::int64_t> After(std::int64_t moment) const {
    if (moment < begin) return begin;
    if (step == 0) return std::nullopt;
    const std::int64_t next = begin + ((moment - begin) / step + 1) * step;
    return next <= end ? std::optional(next) : std::nullopt;
  }
  [[nodiscard]] std::optional<std::int64_t> Until(std::int64_t moment) const {
    if (moment < begin) return std::nullopt;
    if (step == 0) return begin;
    return begin + (std::min(moment, end) - begin) / step * step;
  }
};

civil_second At(const civil_day& day, int minute) { return civil_minute(day) + minute; }

std::vector<Moments> MomentsOn(const civil_day& day, const Schedule& schedule,
                               const cctz::time_zone& zone) {
  std::vector<Moments> all;
  for (const int minute : schedule.at_min) {
    const std::int64_t moment = MomentOf(At(day, minute), zone, Which::kFirst);
    all.push_back({moment, moment, 0});
  }
  if (schedule.every_min == 0) return all;
  const bool to_midnight = schedule.until_min == kMinutesADay;
  const bool ends_next_day = schedule.until_min < schedule.from_min;
  const std::int64_t end =
      MomentOf(At(ends_next_day ? day + 1 : day, schedule.until_min), zone, Which::kSecond);
  // Midnight is the next day's.
  all.push_back({MomentOf(At(day, schedule.from_min), zone, Which::kFirst),
                 to_midnight ? end - 1 : end, schedule.every_min * std::int64_t{60'000}});
  return all;
}

bool IsDueOn(const civil_day& day, const Schedule& schedule) {
  if (schedule.once) {
    return day == civil_day(schedule.once->year, schedule.once->month, schedule.once->day);
  }
  return schedule.days.empty() || schedule.days.contains(static_cast<int>(cctz::get_weekday(day)));
}

civil_day DayAt(std::int64_t unix_ms, const cctz::time_zone& zone) {
  return civil_day(cctz::convert(SecondAt(unix_ms), zone));
}

}  // namespace

std::optional<std::int64_t> NextDue(const Schedule& schedule, std::int64_t after_unix_ms) {
  const auto zone = Load(schedule.zone);
  if (!zone) return std::nullopt;
  std::optional<std::int64_t> next;
  const auto look_at = [&](const civil_day& day) {
    if (!IsDueOn(day, schedule)) return;
    for (const Moments& moments : MomentsOn(day, schedule, *zone)) {
      const auto moment = moments.After(after_unix_ms);
      if (moment && (!next || *moment < *next)) next = moment;
    }
  };
  if (schedule.once) {
    look_at(civil_day(schedule.once->year, schedule.once->month, schedule.once->day));
    return next;
  }
  // The day after the first that has one may have an earlier one, if a period goes on over
  // midnight.
  const civil_day first = DayAt(after_unix_ms, *zone) - 1;
  for (int i = 0; i <= kMostDaysToNext; ++i) look_at(first + i);
  return next;
}

std::vector<std::int64_t> Upcoming(const Schedule& schedule, std::int64_t after_unix_ms,
                                   std::int64_t until_unix_ms, std::size_t most) {
  std::vector<std::int64_t> upcoming;
  auto next = NextDue(schedule, after_unix_ms);
  while (next && *next <= until_unix_ms && upcoming.size() < most) {
    upcoming.push_back(*next);
    next = NextDue(schedule, *next);
  }
  return upcoming;
}

std::optional<std::int64_t> LastDue(const Schedule& schedule, std::int64_t after_unix_ms,
                                    std::int64_t until_unix_ms) {
  const auto zone = Load(schedule.zone);
  if (!zone) return std::nullopt;
  std::optional<std::int64_t> last;
  const auto look_at = [&](const civil_day& day) {
    if (!IsDueOn(day, schedule)) return;
    for (const Moments& moments : MomentsOn(day, schedule, *zone)) {
      const auto moment = moments.Until(until_unix_ms);
      if (moment && *moment > after_unix_ms && (!last || *moment > *last)) last = moment;
    }
  };
  if (schedule.once) {
    look_at(civil_day(schedule.once->year, schedule.once->month, schedule.once->day));
    return last;
  }
  const civil_day today = DayAt(until_unix_ms, *zone);
  for (int i = 0; i <= kMostDaysToNext; ++i) look_at(today - i);
  return last;
}

Result<void> CheckZone(const std::string& zone) {
  if (Load(zone)) return {};
  return Fail(ErrorCode::kInvalidArgument,
              "there is no time zone '{}': a name of the time zone database is expected, as "
              "Europe/Berlin, America/New_York or UTC",
              zone);
}

Result<void> CheckDate(const Date& date) {
  static constexpr const char* kMonths[] = {"January",   "February", "March",    "April",
                                            "May",       "June",     "July",     "August",
                                            "September", "October",  "November", "December"};
  if (date.year < 1970 || date.year > 9999 || date.month < 1 || date.month > 12) {
    return Fail(ErrorCode::kInvalidArgument,
                "{:04}-{:02}-{:02} is no day: YEAR-MONTH-DAY is expected, as 2026-12-24", date.year,
                date.month, date.day);
  }
  const int days = (civil_day(cctz::civil_month(date.year, date.month) + 1) - 1).day();
  if (date.day >= 1 && date.day <= days) return {};
  return Fail(ErrorCode::kInvalidArgument, "{:04}-{:02}-{:02} does not exist: {} {} has {} days",
              date.year, date.month, date.day, kMonths[date.month - 1], date.year, days);
}

std::string TextIn(const std::string& zone, std::int64_t unix_ms) {
  return cctz::format("%a %Y-%m-%d %H:%M %Z", SecondAt(unix_ms),
                      Load(zone).value_or(cctz::utc_time_zone()));
}

std::string MissionId(const Schedule& schedule, std::int64_t due_unix_ms) {
  return schedule.name + "-" +
         cctz::format("%Y%m%dT%H%MZ", SecondAt(due_unix_ms), cctz::utc_time_zone());
}

}  // namespace trailcast::schedule
