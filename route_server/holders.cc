#include "route_server/holders.h"

#include <algorithm>

#include "services/exchange/bounds.h"

namespace trailcast::server {

void Holders::Note(const exchange::AgentStatus& status) {
  // One that has just started has not looked yet.
  if (status.mode == exchange::AgentMode::kStarting) return;
  const auto known = held_.find(status.agent);
  if (known != held_.end()) {
    known->second = status.held;
  } else if (!status.held.empty() && held_.size() < kMostAgents) {
    held_.emplace(status.agent, status.held);
  }
}

std::vector<exchange::Holding> Holders::Of(const std::vector<route::RouteInfo>& routes) const {
  std::vector<exchange::Holding> holdings;
  for (const route::RouteInfo& info : routes) {
    for (const auto& [agent, held] : held_) {
      if (std::find(held.begin(), held.end(), info.key) == held.end()) continue;
      if (holdings.size() == exchange::kMaxHoldingsPerReply) return holdings;
      holdings.push_back({info.key, agent});
    }
  }
  return holdings;
}

}  // namespace trailcast::server
