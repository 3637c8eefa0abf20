#include "services/base/unix_time.h"

#include <fmt/chrono.h>

#include <ctime>

namespace trailcast {

std::string DateText(std::int64_t unix_ms) {
  constexpr std::int64_t kYear10000 = 253'402'300'800'000;
  std::tm parts{};
  const auto seconds = static_cast<std::time_t>(unix_ms / 1000);
  const bool is_date = unix_ms > 0 && unix_ms < kYear10000;
  if (!is_date || gmtime_r(&seconds, &parts) == nullptr) return "at an unknown time";
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", parts);
}

}  // namespace trailcast
