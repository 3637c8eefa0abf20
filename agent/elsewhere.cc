#include "agent/elsewhere.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace trailcast::agent {

using mission::Task;

bool Elsewhere::Begin(std::span<const Task> way, std::uint32_t task, std::string lost) {
  lost_ = std::move(lost);
  not_on_.clear();
  routes_.clear();
  if (++times_ > kMostTimes) return false;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Task& next = way[(task + i) % way.size()];
    const auto is_known = [&](const Task& known) {
      return known.route.route == next.route.route && known.route.revision == next.route.revision;
    };
    if (next.kind != Task::Kind::kFollow || std::any_of(routes_.begin(), routes_.end(), is_known)) {
      continue;
    }
    routes_.push_back({.route = next.route});
  }
  return looks();
}

bool Elsewhere::NotThere() {
  not_on_ += fmt::format("{}{}", not_on_.empty() ? "" : " or ", routes_.front().route.route);
  routes_.pop_front();
  return routes_.empty();
}

void Elsewhere::Reset() {
  End();
  times_ = 0;
}

std::string Elsewhere::Lost() const {
  return not_on_.empty() ? lost_
                         : fmt::format("{}; and it does not find itself on {}", lost_, not_on_);
}

}  // namespace trailcast::agent
