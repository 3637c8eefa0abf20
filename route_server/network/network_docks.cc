// This part of NetworkRegistry keeps docks, who is at them, and when robots charge.
#include <fmt/format.h>

#include "route_server/network/network_ids.h"
#include "route_server/network/network_registry.h"

namespace trailcast::server {

Result<std::vector<NetworkRegistry::Dock>> NetworkRegistry::Docks() {
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  std::vector<Dock> docks;
  for (const auto& [name, named] : named_) {
    if (!named.dock || !IsUsed(named.place)) continue;
    auto also = AlsoAt(named.place);
    if (!also) return tl::unexpected(also.error());
    Dock& dock = docks.emplace_back(Dock{name, *std::move(also), {}});
    dock.places.insert(dock.places.begin(), named.place);
    const auto holders = dock_holders_.find(name);
    if (holders != dock_holders_.end()) dock.holders = holders->second;
  }
  return docks;
}

Result<void> NetworkRegistry::HoldDock(const std::string& name, const std::set<AgentId>& holders) {
  const auto known = dock_holders_.find(name);
  if (known == dock_holders_.end() ? holders.empty() : known->second == holders) return {};
  if (auto stored = store_->HoldDock(name, holders); !stored) return stored;
  dock_holders_[name] = holders;
  return {};
}

Result<std::vector<std::string>> NetworkRegistry::SetCharge(
    const std::optional<network::ChargeLimits>& limits) {
  if (auto put = store_->Put(limits); !put) return tl::unexpected(put.error());
  charge_limits_ = limits;
  return std::vector{network::ToText(limits)};
}

Result<std::vector<std::string>> NetworkRegistry::VacateDocks(const network::Condition& where) {
  std::vector<std::string> lines;
  for (const auto& [name, named] : named_) {
    const auto held = dock_holders_.find(name);
    const bool is_there = KeyOf(named.place.route).route.value() == where.route &&
                          named.place.along_m >= where.from_m && named.place.along_m <= where.to_m;
    if (!is_there || held == dock_holders_.end()) continue;
    const std::set<AgentId> holders = held->second;
    if (auto left = HoldDock(name, {}); !left) return tl::unexpected(left.error());
    for (const AgentId& agent : holders) {
      places_.Erase(agent);
      sent_off_.insert(agent);
      lines.push_back(fmt::format("{} no longer has {}", agent.value(), name));
    }
  }
  return lines;
}

Result<network::Place> NetworkRegistry::PlaceOf(const std::string& goal) const {
  return network::ParseGoal(goal).and_then(
      [this](const network::Goal& parsed) { return Resolve(parsed); });
}

}  // namespace trailcast::server
