#pragma once

#include <chrono>
#include <map>
#include <set>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"

namespace trailcast::server {

// Knows which revisions each agent holds, by its last report. An agent that is switched off or out
// of reach still holds them for a while. One that was not heard for days is no longer listed.
class Holders {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::hours kForgotten{3 * 24};
  // Strangers can make up names, so beyond this number the one with the oldest news is forgotten.
  static constexpr std::size_t kMostAgents = 4096;

  void Note(const exchange::AgentStatus& status, Time now);
  // Returns the holders of these routes, as many as a reply can have.
  [[nodiscard]] std::vector<exchange::Holding> Of(const std::vector<route::RouteInfo>& routes,
                                                  Time now) const;

 private:
  struct Held {
    std::vector<route::RouteKey> keys;
    Time heard;
  };
  void Forget(const AgentId& agent, const Held& held);

  NewestMap<AgentId, Held> held_{kMostAgents};
  std::map<route::RouteKey, std::set<AgentId>>
      holders_;  // the same, for the catalog's many questions
};

}  // namespace trailcast::server
