#include "route_server/fleet/route_followers.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "services/exchange/bounds.h"

namespace trailcast::server {

void FollowerRegistry::Handle(const exchange::Message& message, Time now) {
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    if (status->role == exchange::AgentRole::kFollower) Hear(*status, now);
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    const auto on = on_.find(gone->agent);
    if (on == on_.end()) return;
    Known& known = routes_.at(on->second).followers.at(gone->agent);
    if (known.instance == gone->instance) known.heard = false;
  }
}

void FollowerRegistry::Hear(const exchange::AgentStatus& status, Time now) {
  const auto on = on_.find(status.agent);
  const bool known = on != on_.end();
  if (status.mode == exchange::AgentMode::kArrived) {
    if (known) Remove(status.agent, now);
    return;
  }
  if (!status.place || (!known && on_.size() >= kMostFollowers)) return;
  if (known && on->second != status.place->key) Remove(status.agent, now);
  on_[status.agent] = status.place->key;
  Route& route = routes_[status.place->key];
  const bool joins = !route.followers.contains(status.agent);
  route.followers[status.agent] = {status.instance, status.place->along_m, status.speed_mps, true,
                                   now};
  if (joins) route.due = next_ = now;
}

void FollowerRegistry::Remove(const AgentId& agent, Time now) {
  const auto on = on_.find(agent);
  const auto route = routes_.find(on->second);
  on_.erase(on);
  route->second.followers.erase(agent);
  if (route->second.followers.empty()) {
    routes_.erase(route);
  } else if (route->second.followers.size() == 1) {
    route->second.alone_until = now + kAlone;
    route->second.due = next_ = now;
  }
}

std::vector<exchange::RouteFollowers> FollowerRegistry::Due(Time now) {
  std::vector<exchange::RouteFollowers> due;
  if (now < next_) return due;
  next_ = now + kAloneEvery;
  std::vector<AgentId> forgotten;
  for (auto& [key, route] : routes_) {
    const bool tell = route.followers.size() > 1 || (route.alone_until && now < *route.alone_until);
    if (now >= route.due) {
      for (const auto& [agent, known] : route.followers) {
        if (!known.heard && now - known.told_at > kRemembered) forgotten.push_back(agent);
      }
      if (tell) due.push_back(Tell(key, route, now));
      const auto every = std::max<std::chrono::milliseconds>(
          route.followers.size() > 1 ? kEvery : std::chrono::milliseconds(kAloneEvery),
          kForEachFollower * static_cast<int>(route.followers.size()));
      route.due = now + every;
    }
    next_ = std::min(next_, route.due);
  }
  for (const AgentId& agent : forgotten) Remove(agent, now);
  return due;
}

exchange::RouteFollowers FollowerRegistry::Tell(const route::RouteKey& key, Route& route,
                                                Time now) {
  using std::chrono::milliseconds;
  exchange::RouteFollowers told{.server = server_, .key = key, .followers = {}};
  for (const auto& [agent, known] : route.followers) {
    if (told.followers.size() == exchange::kMaxFollowersTold) break;
    told.followers.push_back(
        {.agent = agent,
         .along_m = known.along_m,
         .speed_mps = known.speed_mps,
         .heard = known.heard,
         .age = std::chrono::duration_cast<milliseconds>(now - known.told_at)});
  }
  return told;
}

}  // namespace trailcast::server
