#pragma once

#include <chrono>
#include <map>
#include <set>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"

namespace trailcast::server {

// Which agent said last that it holds which revisions. It still does when it is switched off or out
// of reach, for a while; one that was not heard of for so many days is told of no longer.
class Holders {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::hours kForgotten{3 * 24};
  // Strangers can make up names: beyond it the one is forgotten that was not heard of for longest.
  static constexpr std::size_t kMostAgents = 4096;

  void Note(const exchange::AgentStatus& status, Time now);
  // Of the routes given, as many as a reply carries.
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
