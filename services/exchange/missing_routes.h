#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::exchange {

// These are routes that agents say they hold and a server does not, since it was restored from an
// old backup or replaces an old server. No clock, no I/O.
class MissingRoutes {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using IsHere = std::function<bool(const route::RouteKey&)>;
  static constexpr std::chrono::milliseconds kAskEvery{3'000};
  static constexpr int kMostAsked = 5;  // in vain; a change of an agent's list allows more
  static constexpr std::size_t kMostAgents = 4096;
  static constexpr std::size_t kMostKeys = 65'536;
  static constexpr std::size_t kMostAtATime = 64;

  // Takes in an agent's status. An agent that says the same as before costs nothing.
  void Hear(const AgentStatus& status);
  // Returns the routes to ask for now: "who has this route?"
  [[nodiscard]] std::vector<route::RouteKey> Due(Time now, const IsHere& is_here);

 private:
  struct Asked {
    Time next{};
    int times = 0;
  };

  std::map<AgentId, std::vector<route::RouteKey>> told_;
  // It is not known of these routes that they are here.
  std::map<route::RouteKey, Asked> held_elsewhere_;
};

}  // namespace trailcast::exchange
