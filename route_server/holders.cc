#include "route_server/holders.h"

#include "services/exchange/bounds.h"

namespace trailcast::server {

void Holders::Note(const exchange::AgentStatus& status, Time now) {
  // One that has just started has not looked yet.
  if (status.mode == exchange::AgentMode::kStarting) return;
  const auto known = held_.find(status.agent);
  const bool is_new = known == held_.end();
  if (is_new && (status.held.empty() || held_.size() >= kMostAgents)) return;
  Held& agent = held_[status.agent];
  agent.heard = now;
  std::vector<route::RouteKey>& held = agent.keys;
  if (held == status.held) return;
  for (const route::RouteKey& key : held) {
    std::set<AgentId>& holders = holders_[key];
    holders.erase(status.agent);
    if (holders.empty()) holders_.erase(key);
  }
  held = status.held;
  for (const route::RouteKey& key : held) holders_[key].insert(status.agent);
}

std::vector<exchange::Holding> Holders::Of(const std::vector<route::RouteInfo>& routes,
                                           Time now) const {
  std::vector<exchange::Holding> holdings;
  for (const route::RouteInfo& info : routes) {
    const auto holders = holders_.find(info.key);
    if (holders == holders_.end()) continue;
    for (const AgentId& agent : holders->second) {
      if (holdings.size() == exchange::kMaxHoldingsPerReply) return holdings;
      if (now - held_.at(agent).heard > kForgotten) continue;
      holdings.push_back({info.key, agent});
    }
  }
  return holdings;
}

}  // namespace trailcast::server
