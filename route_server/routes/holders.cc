#include "route_server/routes/holders.h"

#include "services/exchange/bounds.h"

namespace trailcast::server {

void Holders::Note(const exchange::AgentStatus& status, Time now) {
  // An agent that has just started has not looked yet.
  if (status.mode == exchange::AgentMode::kStarting) return;
  const bool is_new = held_.Find(status.agent) == nullptr;
  if (is_new && status.held.empty()) return;
  Held& agent = held_.Touch(status.agent,
                            [this](const AgentId& gone, const Held& its) { Forget(gone, its); });
  agent.heard = now;
  if (agent.keys == status.held) return;
  Forget(status.agent, agent);
  agent.keys = status.held;
  for (const route::RouteKey& key : agent.keys) holders_[key].insert(status.agent);
}

void Holders::Forget(const AgentId& agent, const Held& held) {
  for (const route::RouteKey& key : held.keys) {
    const auto holders = holders_.find(key);
    if (holders == holders_.end()) continue;  // it was named twice
    holders->second.erase(agent);
    if (holders->second.empty()) holders_.erase(holders);
  }
}

std::vector<exchange::Holding> Holders::Of(const std::vector<route::RouteInfo>& routes,
                                           Time now) const {
  std::vector<exchange::Holding> holdings;
  for (const route::RouteInfo& info : routes) {
    const auto holders = holders_.find(info.key);
    if (holders == holders_.end()) continue;
    for (const AgentId& agent : holders->second) {
      if (holdings.size() == exchange::kMaxHoldingsPerReply) return holdings;
      if (now - held_.Find(agent)->heard > kForgotten) continue;
      holdings.push_back({info.key, agent});
    }
  }
  return holdings;
}

}  // namespace trailcast::server
