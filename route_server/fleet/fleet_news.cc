#include "route_server/fleet/fleet_news.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "services/exchange/bounds.h"

namespace trailcast::server {

void FleetNews::Handle(const exchange::Message& message) {
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    if (status->mode == exchange::AgentMode::kStopped) {
      End(status->agent, status->instance);
    } else {
      Hear(*status);
    }
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    End(gone->agent, gone->instance);
  }
}

void FleetNews::Hear(const exchange::AgentStatus& status) {
  const Process process{status.instance, status.mode == exchange::AgentMode::kStarting};
  const auto first = agents_.find(status.agent);
  if (first == agents_.end()) {
    if (agents_.size() < kMostAgents) agents_[status.agent] = process;
    return;
  }
  const auto claim = claims_.find(status.agent);
  if (first->second.instance != process.instance) {
    if (claim != claims_.end() && claim->second.process.instance == process.instance) {
      claim->second.process = process;
    } else {
      claims_[status.agent] = {process, 0};
      claims_changed_ = true;
    }
    return;
  }
  first->second = process;
  if (claim == claims_.end() || claim->second.keeps != 0) return;
  const Process& other = claim->second.process;
  claim->second.keeps = process.starting && other.starting
                            ? std::min(process.instance, other.instance)
                            : process.instance;
  claims_changed_ = true;
  notes_.push_back(
      fmt::format("two processes are called '{}', instances {:016x} and {:016x}: the first keeps "
                  "the name, the other needs another --name",
                  status.agent.value(), claim->second.keeps,
                  claim->second.keeps == process.instance ? other.instance : process.instance));
}

void FleetNews::End(const AgentId& agent, std::uint64_t instance) {
  const auto first = agents_.find(agent);
  const auto claim = claims_.find(agent);
  if (claim != claims_.end()) {
    const bool later = claim->second.process.instance == instance;
    const bool former = first->second.instance == instance;
    if (!later && !former) return;
    if (former) first->second = claim->second.process;
    claims_.erase(claim);
    claims_changed_ = true;
  } else if (first != agents_.end() && first->second.instance == instance) {
    agents_.erase(first);
  }
}

std::optional<exchange::Fleet> FleetNews::Due(Time now) {
  const std::size_t difference =
      agents_.size() > told_agents_ ? agents_.size() - told_agents_ : told_agents_ - agents_.size();
  if (told_at_) {
    const auto since = now - *told_at_;
    const bool many = 10 * difference > told_agents_;
    const bool due = (claims_changed_ && since >= kClaimsEvery) ||
                     (many && since >= kNumberEvery) || (difference > 0 && since >= kLittleEvery);
    if (!due) return std::nullopt;
  }
  told_at_ = now;
  told_agents_ = agents_.size();
  claims_changed_ = false;
  exchange::Fleet fleet{
      .server = server_, .agents = static_cast<std::uint32_t>(agents_.size()), .claimed = {}};
  for (const auto& [agent, claim] : claims_) {
    if (fleet.claimed.size() == exchange::kMaxClaimedNames) break;
    fleet.claimed.push_back({agent, claim.process.instance, claim.keeps});
  }
  return fleet;
}

std::vector<std::string> FleetNews::TakeNotes() { return std::exchange(notes_, {}); }

std::string FleetNews::NameTrouble() const {
  for (const auto& [agent, claim] : claims_) {
    if (claim.keeps == 0 || claim.process.starting) continue;
    return fmt::format("two processes are called '{}'", agent.value());
  }
  return "";
}

}  // namespace trailcast::server
