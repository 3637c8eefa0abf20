#include "agent/link/neighbours.h"

#include <algorithm>
#include <variant>

namespace trailcast::agent {

void Neighbours::Handle(const exchange::Message& message, Time now) {
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    if (status->role == exchange::AgentRole::kFollower && status->agent != self_) {
      Handle(*status, now);
    }
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    Handle(*gone);
  } else if (const auto* told = std::get_if<exchange::RouteFollowers>(&message)) {
    Handle(*told, now);
  }
}

void Neighbours::Handle(const exchange::AgentGone& gone) {
  for (auto& [agent, known] : known_) {
    const bool itself = agent == gone.agent && known.instance == gone.instance;
    if (itself || known.told_by == gone.agent) known.neighbour.heard = false;
  }
}

// The latest report counts, wherever it comes from.
void Neighbours::Handle(const exchange::RouteFollowers& told, Time now) {
  std::erase_if(known_, [&](const auto& entry) {  // those that have arrived, or left the route
    const auto& known = entry.second;
    return known.told_by == told.server && known.route == told.key &&
           std::none_of(told.followers.begin(), told.followers.end(),
                        [&](const auto& one) { return one.agent == entry.first; });
  });
  for (const exchange::RouteFollower& one : told.followers) {
    const Time told_at = now - one.age;
    const auto known = known_.find(one.agent);
    const bool older = known != known_.end() && known->second.told_by != told.server &&
                       told_at <= known->second.neighbour.told_at;
    if (one.agent == self_ || older) continue;
    if (known_.size() >= kMost && known == known_.end()) MakeRoom();
    known_[one.agent] = {
        0, told.key, {one.agent, one.along_m, one.speed_mps, told_at, one.heard}, told.server};
  }
}

void Neighbours::Handle(const exchange::AgentStatus& status, Time now) {
  if (status.mode == exchange::AgentMode::kArrived) {
    known_.erase(status.agent);
  } else if (status.place) {
    if (known_.size() >= kMost && !known_.contains(status.agent)) MakeRoom();
    known_[status.agent] = {
        status.instance,
        status.place->key,
        {status.agent, status.place->along_m, status.speed_mps, now, /*heard=*/true},
        std::nullopt};
  }
}

void Neighbours::MakeRoom() {
  const auto told_earlier = [](const auto& a, const auto& b) {
    return a.second.neighbour.told_at < b.second.neighbour.told_at;
  };
  known_.erase(std::min_element(known_.begin(), known_.end(), told_earlier));
}

std::vector<Neighbour> Neighbours::On(const route::RouteKey& route) const {
  std::vector<Neighbour> on;
  for (const auto& [agent, known] : known_) {
    if (known.route == route) on.push_back(known.neighbour);
  }
  return on;
}

std::vector<Neighbour> Neighbours::Forget(Time now) {
  std::vector<Neighbour> forgotten;
  for (auto known = known_.begin(); known != known_.end();) {
    const Neighbour& neighbour = known->second.neighbour;
    // A server's report on a route names all robots on it.
    const bool silent = !neighbour.heard || known->second.told_by;
    if (silent && now - neighbour.told_at > kRemembered) {
      forgotten.push_back(neighbour);
      known = known_.erase(known);
    } else {
      ++known;
    }
  }
  return forgotten;
}

}  // namespace trailcast::agent
