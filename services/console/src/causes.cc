// This file finds what in the fleet people have to see to, in words for people.
#include <fmt/format.h>

#include "services/console/fleet_state.h"
#include "services/fleet/now_client.h"

namespace trailcast::console {
namespace {

using exchange::AgentMode;
using exchange::AgentRole;
using exchange::AgentStatus;
using fleet::RobotState;

constexpr const char* kBattery = "battery";
constexpr int kLow_percent = 20;
constexpr int kChargedAgain_percent = 25;

std::string PlaceText(const std::string& route, double along_m) {
  return fmt::format("{:.1f} m of {}", along_m, route);
}

}  // namespace

void FleetState::AddCauses(const Agent& agent, const Standing& standing, const Alerts& open,
                           std::vector<Cause>& causes) const {
  const AgentStatus& status = agent.status;
  const std::string& name = status.agent.value();
  std::string place = status.route;
  if (status.place) {
    place = PlaceText(status.route, status.place->along_m);
  } else if (agent.stood) {
    place = "last " + PlaceText(agent.stood->route, agent.stood->place.along_m);
  }
  const auto add = [&](const char* kind, bool alarm, std::string reason, std::string action) {
    causes.push_back({.kind = kind,
                      .subject = name,
                      .alarm = alarm,
                      .reason = std::move(reason),
                      .place = place,
                      .action = std::move(action)});
  };
  const auto with = [](std::string what, const std::string& detail) {
    return detail.empty() ? what : what + ": " + detail;
  };
  // This is what the robot was last doing. It has no time, because that would change all the time.
  const std::string last = fleet::LastSeenText(status, std::nullopt);
  const std::string orders =
      standing.mission == nullptr ? "" : " '" + standing.mission->mission.orders + "'";
  if (agent.open_stop) {
    add("not-stopped", true, "Told to stop, and does not answer: " + last,
        "It may be moving: use its red button.");
  }
  const bool failed = standing.last != nullptr && standing.last->state == mission::State::kFailed;
  if (standing.state == RobotState::kFault) {
    add("fault", true, with("Fault", status.detail),
        "Look at the robot. This ends once the robot says so no more.");
  } else if (standing.state == RobotState::kOffline && standing.mission != nullptr) {
    add("offline", true, fmt::format("Offline in the middle of its mission{}, {}", orders, last),
        "It may be driving on: look for it. This ends once it is heard, or dismissed.");
  } else if (failed) {
    add("failed", true, with("Mission failed", standing.last->detail),
        "See what its camera shows. Bring it back to its path, or send it anew from where it "
        "stands.");
  } else if (standing.mission != nullptr &&
             (standing.state == RobotState::kPaused || standing.state == RobotState::kStopped)) {
    const bool stopped = standing.state == RobotState::kStopped;
    add("held", false,
        with(fmt::format("{} in the middle of its mission{}", stopped ? "Stopped" : "Paused",
                         orders),
             status.detail),
        stopped ? "Once the way is free, release it and resume, or cancel its mission."
                : "Once the way is free, resume it, or cancel its mission.");
  }
  if (status.battery_percent) {
    const int percent = *status.battery_percent;
    const bool was = open.IsOpen(name, kBattery);
    if (percent < (was ? kChargedAgain_percent : kLow_percent)) {
      add(kBattery, false, fmt::format("Battery {} %", percent), "Charge it.");
    }
  }
}

FleetState::ToSeeTo FleetState::WhatToSeeTo(const Alerts& open) const {
  ToSeeTo found;
  const Latest latest = LatestMissions();
  for (const auto& [name, agent] : agents_) {
    if (agent.status.role == AgentRole::kOperator) continue;
    found.subjects.insert(name.value());
    if (agent.status.role == AgentRole::kServer) {
      if (!agent.silent && agent.status.mode != AgentMode::kStopped) continue;
      found.causes.push_back({.kind = "server-offline",
                              .subject = name.value(),
                              .of_server = true,
                              .alarm = true,
                              .reason = "Route server offline",
                              .action = "See that its program runs and that the network reaches "
                                        "it. Robots drive on with what they have."});
      continue;
    }
    const auto mission = latest.find(name);
    const auto* of_robot = mission == latest.end() ? nullptr : mission->second;
    if (of_robot == nullptr && !missions_told_) found.unsure.insert(name.value());
    AddCauses(agent, StandingOf(agent, of_robot), open, found.causes);
  }
  return found;
}

}  // namespace trailcast::console
