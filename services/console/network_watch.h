#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/console/desk.h"
#include "services/console/network_list.h"

namespace trailcast::console {

// All lines of a server's answer; not `whole` where there are more than are taken.
struct NetworkAnswer {
  std::vector<std::string> lines{};
  bool whole = true;
};
[[nodiscard]] Result<NetworkAnswer> AskForNetwork(Desk& desk, const std::string& words);

// How routes are joined, as a server last said to whoever looked: it is asked once for all who look
// at once, and the less often the longer its answer takes. Any thread.
class NetworkWatch {
 public:
  // Of a list that somebody asks for.
  static constexpr std::chrono::milliseconds kFresh{2000};
  // Servers are asked for at most one part in so many of the time.
  static constexpr int kShare = 20;
  // Who waits for the first list; more are refused.
  static constexpr int kMostWaiting = 4;

  explicit NetworkWatch(Desk& desk) : desk_(desk) {}

  // While a newer one is under way, the last. kUnavailable: no server answers, or too many wait.
  [[nodiscard]] Result<std::shared_ptr<const NetworkList>> Now();
  // What is known is of before.
  void Changed();

 private:
  using Clock = std::chrono::steady_clock;
  using Outcome = Result<std::shared_ptr<const NetworkList>>;

  Desk& desk_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable told_;
  bool asking_ = false;
  int waiting_ = 0;
  std::size_t changes_ = 0;
  std::shared_ptr<const NetworkList> list_;
  Clock::time_point fresh_until_{};
  std::optional<Outcome> last_;
};

}  // namespace trailcast::console
