#include "agent/elsewhere.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace trailcast::agent {

using mission::Task;

bool Elsewhere::Begin(std::span<const Task> way, std::uint32_t task, std::string lost,
                      const std::vector<std::string>& seen, const Turning& turning) {
  lost_ = std::move(lost);
  not_on_.clear();
  looks_.clear();
  if (++times_ > kMostTimes) return false;
  std::vector<Task> routes;
  const auto add = [&](const route::RouteRef& route) {
    const auto is_it = [&](const Task& known) { return known.route.route == route.route; };
    if (std::none_of(routes.begin(), routes.end(), is_it)) routes.push_back({.route = route});
  };
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Task& next = way[(task + i) % way.size()];
    if (next.kind == Task::Kind::kFollow) add(next.route);
    if (i > 0) continue;
    for (const std::string& name : seen) add({name});
  }
  for (const bool turns : {false, true}) {
    const bool looks = turns ? turning.may_turn : turning.knows_lens || !turning.may_turn;
    for (const Task& route : routes) {
      if (looks) looks_.push_back({route, turns});
    }
  }
  return this->looks();
}

bool Elsewhere::NotThere() {
  const std::string& route = looks_.front().route.route.route;
  if (std::find(not_on_.begin(), not_on_.end(), route) == not_on_.end()) not_on_.push_back(route);
  looks_.pop_front();
  return looks_.empty();
}

void Elsewhere::Reset() {
  End();
  times_ = 0;
}

std::string Elsewhere::Lost() const {
  if (not_on_.empty()) return lost_;
  return fmt::format("{}; and it does not find itself on {}", lost_, fmt::join(not_on_, " or "));
}

}  // namespace trailcast::agent
