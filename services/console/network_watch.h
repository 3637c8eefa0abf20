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

// These are all lines of a server's answer. It is not `whole` if there are more than are accepted.
struct NetworkAnswer {
  std::vector<std::string> lines{};
  bool whole = true;
};
[[nodiscard]] Result<NetworkAnswer> AskForNetwork(Desk& desk, const std::string& words);

// This is how routes are joined, by a server's last answer. One question serves all callers at the
// same time, and the longer its answer takes, the less often it is asked. It may be used from any
// thread.
class NetworkWatch {
 public:
  // A list is fresh for this long.
  static constexpr std::chrono::milliseconds kFresh{2000};
  // Asking servers takes at most one in so many parts of the time.
  static constexpr int kShare = 20;
  // So many callers may wait for the first list. More are refused.
  static constexpr int kMostWaiting = 4;

  explicit NetworkWatch(Desk& desk) : desk_(desk) {}

  // Returns the list, or the last one while a newer one is being fetched. Fails with kUnavailable
  // if no server answers, or too many wait.
  [[nodiscard]] Result<std::shared_ptr<const NetworkList>> Now();
  // Notes that the network has changed since the list was made.
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
