#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace trailcast {

// Milliseconds since 1970.
[[nodiscard]] inline std::int64_t UnixMs(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}
// By this machine's clock.
[[nodiscard]] inline std::int64_t NowUnixMs() { return UnixMs(std::chrono::system_clock::now()); }

// "2026-11-24 05:30 UTC", or "at an unknown time": any number may have been sent, and years have
// four digits here.
[[nodiscard]] std::string DateText(std::int64_t unix_ms);
// The same to the second: "on 2026-11-24 at 05:30:12 UTC".
[[nodiscard]] std::string MomentText(std::int64_t unix_ms);

// "12 s", "5 min", "3 h", "2 d"; what lies in the future is as old as now.
[[nodiscard]] std::string Age(std::int64_t milliseconds);

}  // namespace trailcast
