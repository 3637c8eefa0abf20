#pragma once

#include <chrono>
#include <cstdint>

namespace trailcast {

// Milliseconds since 1970.
[[nodiscard]] inline std::int64_t UnixMs(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}
// By this machine's clock.
[[nodiscard]] inline std::int64_t NowUnixMs() { return UnixMs(std::chrono::system_clock::now()); }

}  // namespace trailcast
