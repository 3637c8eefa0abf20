#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace trailcast {

// Returns milliseconds since 1970.
[[nodiscard]] inline std::int64_t UnixMs(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}
// Returns this machine's time.
[[nodiscard]] inline std::int64_t NowUnixMs() { return UnixMs(std::chrono::system_clock::now()); }

// Returns "2026-11-24 05:30 UTC", or "at an unknown time" for a moment whose year does not have
// four digits: a stranger may have sent any number.
[[nodiscard]] std::string DateText(std::int64_t unix_ms);
// Returns the same with seconds: "on 2026-11-24 at 05:30:12 UTC".
[[nodiscard]] std::string MomentText(std::int64_t unix_ms);

// Returns "12 s", "5 min", "3 h" or "2 d". A moment in the future counts as now.
[[nodiscard]] std::string Age(std::int64_t milliseconds);

}  // namespace trailcast
