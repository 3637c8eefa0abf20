#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string_view>
#include <thread>

namespace trailcast::test {

// How long a test waits for what has to happen. It is far beyond what a busy machine takes, so that
// a fault alone reaches it: a test that passes never waits for it.
inline constexpr std::chrono::seconds kLongEnough{120};

// Asks again and again until `condition` holds. A test in which it does not within kLongEnough
// fails, and names `what` it waited for. The condition may itself wait for a moment.
template <typename Condition>
bool Await(Condition condition, std::string_view what) {
  const auto until = std::chrono::steady_clock::now() + kLongEnough;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) {
      ADD_FAILURE() << "not within " << kLongEnough.count() << " s: " << what;
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace trailcast::test
