#include "route_server/network/charging_rules.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace trailcast::server {

bool IsToCharge(const RobotSeen& robot, const network::ChargeLimits& limits) {
  const bool is_low = robot.battery_percent && *robot.battery_percent < limits.below_percent;
  const bool charges = !robot.dock.empty() && !robot.may_go_on;
  return is_low && !robot.is_sent && !charges;
}

std::string Charges(const RobotSeen& robot, const network::ChargeLimits& limits) {
  if (robot.dock.empty() || robot.may_go_on || IsFull(robot, limits)) return "";
  const std::string now = robot.battery_percent
                              ? fmt::format("its battery is at {} %", *robot.battery_percent)
                              : "it does not tell its battery";
  return fmt::format("{}{}: {}, and it goes on at {} %, or when it is told to resume",
                     network::kChargesAt, robot.dock, now, limits.until_percent);
}

bool IsFull(const RobotSeen& robot, const network::ChargeLimits& limits) {
  return robot.battery_percent && *robot.battery_percent >= limits.until_percent;
}

std::set<AgentId> HoldersNow(const std::set<AgentId>& before, std::span<const Sighting> seen) {
  std::set<AgentId> holders = before;
  for (const Sighting& each : seen) {
    if (each.is_there || each.goes_there) {
      if (each.is_heard) holders.insert(each.agent);
    } else if (each.is_placed) {
      holders.erase(each.agent);
    }
  }
  return holders;
}

bool IsFreeFor(const AgentId& agent, const std::set<AgentId>& holders) {
  return holders.empty() || (holders.size() == 1 && holders.contains(agent));
}

std::string OthersIn(const std::set<AgentId>& holders, const AgentId& agent) {
  std::vector<std::string> others;
  for (const AgentId& holder : holders) {
    if (holder != agent) others.push_back(holder.value());
  }
  return fmt::format("{}", fmt::join(others, " and "));
}

DockChoice ChooseDock(const AgentId& agent, std::span<const DockSeen> docks) {
  if (docks.empty()) {
    return {.why_none =
                "no place is a dock that robots follow a route to: 'trailcast network name "
                "NAME ROUTE@METRES dock' makes it one"};
  }
  const DockSeen* nearest = nullptr;
  const DockSeen* unreached = nullptr;
  std::vector<std::string> taken;
  for (const DockSeen& dock : docks) {
    if (!IsFreeFor(agent, dock.holders)) {
      taken.push_back(fmt::format("{} is taken by {}", dock.name, OthersIn(dock.holders, agent)));
    } else if (!dock.length_m) {
      if (unreached == nullptr) unreached = &dock;
    } else if (nearest == nullptr || *dock.length_m < *nearest->length_m) {
      nearest = &dock;
    }
  }
  if (nearest != nullptr) return {.name = nearest->name};
  if (unreached != nullptr) {
    taken.push_back(fmt::format("{} is not reached: {}", unreached->name, unreached->no_way));
  }
  return {.why_none = fmt::format("no dock is free: {}", fmt::join(taken, ", "))};
}

}  // namespace trailcast::server
