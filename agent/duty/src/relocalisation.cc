#include "agent/duty/src/relocalisation.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace trailcast::agent {

using mission::Task;

void Relocalisation::Begin(std::span<const Task> way, std::uint32_t task, std::string lost,
                           const std::vector<std::string>& seen) {
  lost_ = std::move(lost);
  not_on_.clear();
  routes_.clear();
  ++times_;
  const auto add = [&](const route::RouteRef& route) {
    const auto is_it = [&](const Task& known) { return known.route.route == route.route; };
    if (std::none_of(routes_.begin(), routes_.end(), is_it)) routes_.push_back({.route = route});
  };
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Task& next = way[(task + i) % way.size()];
    if (next.kind == Task::Kind::kFollow) add(next.route);
    if (i > 0) continue;
    for (const std::string& name : seen) add({name});
  }
}

bool Relocalisation::NotThere() {
  not_on_.push_back(routes_.front().route.route);
  routes_.pop_front();
  return routes_.empty();
}

void Relocalisation::Reset() {
  End();
  times_ = 0;
}

std::string Relocalisation::Lost() const {
  if (not_on_.empty()) return lost_;
  return fmt::format("{}; and it does not find itself on {}", lost_, fmt::join(not_on_, " or "));
}

}  // namespace trailcast::agent
