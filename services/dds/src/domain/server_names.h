#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::dds {

// The IPv4 addresses of a name.
using Addresses = std::set<std::string>;
// Looks a name up without waiting. kUnavailable means that it has no address at present.
using LookUp = std::function<std::future<Result<Addresses>>(const std::string& name)>;

// Asks the system on a thread of its own, because that may take many seconds. Closing waits for
// nothing.
[[nodiscard]] std::future<Result<Addresses>> AskTheSystem(const std::string& name);

// The route servers that a process was told to meet, by address or by name, and where they are.
// A name at whose addresses nobody is heard is looked up again, because its machine may have got
// another address. It has no clock.
class ServerNames {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Clock = std::chrono::steady_clock;

  // Nobody was heard at a name's addresses for so long: it is looked up, and again after twice as
  // long each time, up to kAtMost.
  static constexpr std::chrono::seconds kMissed{4};
  static constexpr std::chrono::seconds kAtMost{60};

  explicit ServerNames(const std::vector<std::string>& names, LookUp look_up = AskTheSystem);

  // Looks up all names that have no address yet, and waits for it. kUnavailable tells the first
  // one that still has none.
  [[nodiscard]] Result<void> FindAll();
  // Returns every address, in the order of the names.
  [[nodiscard]] std::vector<std::string> addresses() const;

  // Returns what has changed, in words, if addresses() has, and otherwise an empty text. The caller
  // asks every second or so. `hears` says whether a route server is heard at an address.
  [[nodiscard]] std::string Look(const std::function<bool(const std::string& address)>& hears,
                                 Time now);

 private:
  struct Server {
    std::string name;
    Addresses addresses{};
    std::optional<Time> missed_since{};  // or since the last answer
    Clock::duration patience = kMissed;
    std::future<Result<Addresses>> answer{};  // valid while it is being looked up
  };
  [[nodiscard]] std::string TakeAnswer(Server& server) const;

  std::vector<Server> servers_;
  LookUp look_up_;
};

}  // namespace trailcast::dds
