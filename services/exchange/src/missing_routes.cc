#include "services/exchange/missing_routes.h"

namespace trailcast::exchange {

void MissingRoutes::Hear(const AgentStatus& status) {
  if (status.held.empty()) return;
  if (told_.size() >= kMostAgents && !told_.contains(status.agent)) told_.clear();
  std::vector<route::RouteKey>& before = told_[status.agent];
  if (before == status.held) return;
  before = status.held;
  for (const route::RouteKey& key : status.held) {
    if (held_elsewhere_.size() < kMostKeys) held_elsewhere_.try_emplace(key);
  }
}

std::vector<route::RouteKey> MissingRoutes::Due(Time now, const IsHere& is_here) {
  std::vector<route::RouteKey> due;
  for (auto at = held_elsewhere_.begin(); at != held_elsewhere_.end();) {
    Asked& asked = at->second;
    if (due.size() == kMostAtATime) break;
    if (asked.times > 0 && now < asked.next) {
      ++at;
    } else if (asked.times == kMostAsked || is_here(at->first)) {
      at = held_elsewhere_.erase(at);
    } else {
      due.push_back(at->first);
      ++asked.times;
      asked.next = now + kAskEvery;
      ++at;
    }
  }
  return due;
}

}  // namespace trailcast::exchange
