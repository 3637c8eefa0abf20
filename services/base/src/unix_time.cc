#include "services/base/unix_time.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>
#include <optional>

namespace trailcast {
namespace {

constexpr const char* kUnknown = "at an unknown time";

std::optional<std::tm> PartsOf(std::int64_t unix_ms) {
  constexpr std::int64_t kYear10000 = 253'402'300'800'000;
  std::tm parts{};
  const auto seconds = static_cast<std::time_t>(unix_ms / 1000);
  const bool is_date = unix_ms > 0 && unix_ms < kYear10000;
  if (!is_date || gmtime_r(&seconds, &parts) == nullptr) return std::nullopt;
  return parts;
}

}  // namespace

std::string DateText(std::int64_t unix_ms) {
  const auto parts = PartsOf(unix_ms);
  return parts ? fmt::format("{:%Y-%m-%d %H:%M} UTC", *parts) : kUnknown;
}

std::string MomentText(std::int64_t unix_ms) {
  const auto parts = PartsOf(unix_ms);
  return parts ? fmt::format("on {:%Y-%m-%d at %H:%M:%S} UTC", *parts) : kUnknown;
}

std::string Age(std::int64_t milliseconds) {
  constexpr std::int64_t kMinute_s = 60;
  constexpr std::int64_t kHour_s = 3600;
  constexpr std::int64_t kDay_s = 86400;
  const std::int64_t seconds = std::max<std::int64_t>(0, milliseconds / 1000);
  if (seconds < 2 * kMinute_s) return fmt::format("{} s", seconds);
  if (seconds < 2 * kHour_s) return fmt::format("{} min", seconds / kMinute_s);
  if (seconds < 2 * kDay_s) return fmt::format("{} h", seconds / kHour_s);
  return fmt::format("{} d", seconds / kDay_s);
}

}  // namespace trailcast
