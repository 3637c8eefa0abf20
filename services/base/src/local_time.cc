#include "services/base/local_time.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <optional>
#include <utility>

#include "services/base/number.h"

namespace trailcast {
namespace {

constexpr std::array<std::string_view, 7> kDays = {"sunday",   "monday", "tuesday", "wednesday",
                                                   "thursday", "friday", "saturday"};
constexpr const char* kExpected =
    "a day (monday, yesterday, today, 2026-11-23), a time (09:15, 2026-11-23T09:15) or how long "
    "ago (90min, 12h, 2d, 1w)";

std::optional<std::tm> LocalParts(std::int64_t unix_ms) {
  const auto seconds = static_cast<std::time_t>(unix_ms / 1000);
  std::tm parts{};
  tzset();
  if (localtime_r(&seconds, &parts) == nullptr) return std::nullopt;
  return parts;
}

// Fields beyond their range carry over, as in "the 0th of March".
std::int64_t UnixMsOf(std::tm parts) {
  parts.tm_isdst = -1;
  return static_cast<std::int64_t>(std::mktime(&parts)) * 1000;
}

std::tm Midnight(std::tm parts, int days_before = 0) {
  parts.tm_hour = parts.tm_min = parts.tm_sec = 0;
  parts.tm_mday -= days_before;
  return parts;
}

// Reads all of `text` as kCount numbers: "2026-11-23" with '-' between, "09:15" with ':'.
template <std::size_t kCount>
std::optional<std::array<int, kCount>> Numbers(std::string_view text, char between) {
  std::array<int, kCount> numbers{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::size_t end = i + 1 < kCount ? text.find(between) : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    const auto number = ParseNumber<int>(text.substr(0, end));
    if (!number || *number < 0) return std::nullopt;
    numbers[i] = *number;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return numbers;
}

// Returns false if `text` is no date, or a day that does not exist.
bool SetDate(std::string_view text, std::tm& parts) {
  constexpr int kFirstYear = 1970;
  constexpr int kLastYear = 9999;
  const auto date = Numbers<3>(text, '-');
  if (!date) return false;
  const auto [year, month, day] = *date;
  if (year < kFirstYear || year > kLastYear) return false;
  std::tm asked = Midnight(parts);
  asked.tm_year = year - 1900;
  asked.tm_mon = month - 1;
  asked.tm_mday = day;
  std::tm real = asked;
  real.tm_isdst = -1;
  (void)std::mktime(&real);
  if (real.tm_mon != month - 1 || real.tm_mday != day) return false;
  parts = asked;
  return true;
}

bool SetTime(std::string_view text, std::tm& parts) {
  const auto with_seconds = Numbers<3>(text, ':');
  const auto without = with_seconds ? std::nullopt : Numbers<2>(text, ':');
  if (!with_seconds && !without) return false;
  const int hour = with_seconds ? (*with_seconds)[0] : (*without)[0];
  const int minute = with_seconds ? (*with_seconds)[1] : (*without)[1];
  const int second = with_seconds ? (*with_seconds)[2] : 0;
  if (hour > 23 || minute > 59 || second > 59) return false;
  parts.tm_hour = hour;
  parts.tm_min = minute;
  parts.tm_sec = second;
  return true;
}

std::optional<std::int64_t> SpanMs(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 5> kUnits = {
      {{"min", 60.0}, {"s", 1.0}, {"h", 3600.0}, {"d", 86'400.0}, {"w", 604'800.0}}};
  constexpr double kLongest = 1e6;  // of whichever unit
  for (const auto& [unit, seconds] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const auto count = ParseNumberWithin(text.substr(0, text.size() - unit.size()), 0.0, kLongest);
    if (count) return static_cast<std::int64_t>(*count * seconds * 1000.0);
  }
  return std::nullopt;
}

std::optional<std::int64_t> MomentOf(std::string_view text, std::int64_t now_unix_ms) {
  if (const auto span_ms = SpanMs(text)) return now_unix_ms - *span_ms;
  const auto today = LocalParts(now_unix_ms);
  if (!today) return std::nullopt;
  if (text == "today") return UnixMsOf(Midnight(*today));
  if (text == "yesterday") return UnixMsOf(Midnight(*today, 1));
  const auto* const day = std::find(kDays.begin(), kDays.end(), text);
  if (day != kDays.end()) {
    const auto weekday = static_cast<int>(day - kDays.begin());
    return UnixMsOf(Midnight(*today, (today->tm_wday - weekday + 7) % 7));
  }
  std::tm parts = Midnight(*today);
  if (SetTime(text, parts)) {
    const std::int64_t at = UnixMsOf(parts);
    if (at <= now_unix_ms) return at;
    --parts.tm_mday;
    return UnixMsOf(parts);
  }
  const std::size_t between = text.find_first_of("T ");
  if (!SetDate(text.substr(0, between), parts)) return std::nullopt;
  if (between != std::string_view::npos && !SetTime(text.substr(between + 1), parts)) {
    return std::nullopt;
  }
  return UnixMsOf(parts);
}

}  // namespace

std::string LocalText(std::int64_t unix_ms) {
  constexpr std::int64_t kYear10000 = 253'402'300'800'000;
  const auto parts = unix_ms > 0 && unix_ms < kYear10000 ? LocalParts(unix_ms) : std::nullopt;
  return parts ? fmt::format("{:%a %Y-%m-%d %H:%M}", *parts) : "at an unknown time";
}

Result<std::int64_t> ParseSince(std::string_view text, std::int64_t now_unix_ms) {
  const auto moment = MomentOf(text, now_unix_ms);
  if (!moment) return Fail(ErrorCode::kInvalidArgument, "'{}': expected {}", text, kExpected);
  if (*moment <= now_unix_ms) return *moment;
  return Fail(ErrorCode::kInvalidArgument, "'{}' is yet to come: expected {}", text, kExpected);
}

}  // namespace trailcast
