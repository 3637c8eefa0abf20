#pragma once

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>

namespace trailcast::test {

// Returns a DDS discovery tag, which is different for every call in every process.
inline std::string UniqueTag() {
  static std::atomic<int> count = 0;
  const auto ticks = std::chrono::steady_clock::now().time_since_epoch().count();
  return "test-" + std::to_string(getpid()) + "-" + std::to_string(ticks) + "-" +
         std::to_string(++count);
}

}  // namespace trailcast::test
