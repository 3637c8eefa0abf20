#include "services/base/unix_time.h"

#include <fmt/chrono.h>

#include <ctime>

namespace trailcast {

std::string DateText(std::int64_t unix_ms) {
  std::tm parts{};
  const auto seconds = static_cast<std::time_t>(unix_ms / 1000);
  if (unix_ms <= 0 || gmtime_r(&seconds, &parts) == nullptr) return "at an unknown time";
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", parts);
}

}  // namespace trailcast
