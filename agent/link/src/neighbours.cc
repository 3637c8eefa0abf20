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
    const auto known = known_.find(gone->agent);
    if (known != known_.end() && known->second.instance == gone->instance) {
      known->second.neighbour.heard = false;
    }
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
        {status.agent, status.place->along_m, status.speed_mps, now, /*heard=*/true}};
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
    if (!neighbour.heard && now - neighbour.told_at > kRemembered) {
      forgotten.push_back(neighbour);
      known = known_.erase(known);
    } else {
      ++known;
    }
  }
  return forgotten;
}

}  // namespace trailcast::agent
