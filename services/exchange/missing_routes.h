#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::exchange {

// What agents say that they hold, and a server does not: it was put back from an old backup, or is
// a new one in the old one's place. No clock, no I/O.
class MissingRoutes {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using IsHere = std::function<bool(const route::RouteKey&)>;
  static constexpr std::chrono::milliseconds kAskEvery{3'000};
  static constexpr int kMostAsked = 5;  // in vain; then not until an agent's list has changed
  static constexpr std::size_t kMostAgents = 4096;
  static constexpr std::size_t kMostKeys = 65'536;
  static constexpr std::size_t kMostAtATime = 64;

  // An agent that says the same as before costs nothing.
  void Hear(const AgentStatus& status);
  // Those to be asked for now: "who has this route?"
  [[nodiscard]] std::vector<route::RouteKey> Due(Time now, const IsHere& is_here);

 private:
  struct Asked {
    Time next{};
    int times = 0;
  };

  std::map<AgentId, std::vector<route::RouteKey>> told_;
  std::map<route::RouteKey, Asked> held_elsewhere_;  // of which it is not known that they are here
};

}  // namespace trailcast::exchange
