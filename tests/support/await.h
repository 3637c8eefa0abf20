#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string_view>
#include <thread>

namespace trailcast::test {

// A test waits this long for what has to happen. It is far beyond what a busy machine takes, so
// that only a fault reaches it: a test that passes never waits for it.
inline constexpr std::chrono::seconds kLongEnough{300};

// Asks every `pause` whether `condition` holds. Returns false if it did not within `bound`.
template <typename Condition>
[[nodiscard]] bool WaitUntil(Condition condition, std::chrono::seconds bound = kLongEnough,
                             std::chrono::milliseconds pause = std::chrono::milliseconds(20)) {
  const auto until = std::chrono::steady_clock::now() + bound;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

// Fails the test if `condition` does not come to hold, and names `what` it waited for. The
// condition may itself wait for a moment.
template <typename Condition>
bool Await(Condition condition, std::string_view what) {
  const bool holds = WaitUntil(condition, kLongEnough, std::chrono::milliseconds(1));
  EXPECT_TRUE(holds) << "not within " << kLongEnough.count() << " s: " << what;
  return holds;
}

}  // namespace trailcast::test
