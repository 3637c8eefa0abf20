#include <array>
#include <cmath>

#include "services/console/fleet_state.h"
#include "services/fleet/robot_state.h"
#include "services/mission/mission.h"

namespace trailcast::console {
namespace {

using exchange::AgentRole;
using exchange::AgentStatus;

constexpr const char* kGauge = "gauge";

constexpr std::array kMissionStates{mission::State::kSent,      mission::State::kAccepted,
                                    mission::State::kRefused,   mission::State::kFetching,
                                    mission::State::kUnderWay,  mission::State::kPaused,
                                    mission::State::kArrived,   mission::State::kFailed,
                                    mission::State::kCancelled, mission::State::kExpired};

}  // namespace

void FleetState::Measure(http::MetricsText& text) const {
  struct Robot {
    const Agent* agent;
    Standing standing;
  };
  std::map<std::string_view, Robot> robots;
  std::map<std::string_view, const Agent*> servers;
  std::map<std::string_view, int> in_state;
  const Latest latest = LatestMissions();
  for (const auto& [name, agent] : agents_) {
    if (agent.status.role == AgentRole::kServer) servers.emplace(name.value(), &agent);
    const bool is_robot =
        agent.status.role == AgentRole::kFollower || agent.status.role == AgentRole::kScout;
    if (!is_robot) continue;
    const auto mission = latest.find(name);
    const Standing standing =
        StandingOf(agent, mission == latest.end() ? nullptr : mission->second);
    robots.emplace(name.value(), Robot{&agent, standing});
    ++in_state[fleet::ToText(standing.state)];
  }

  text.Begin("robots", kGauge, "Robots that were heard, by what they do.");
  for (const char* state : fleet::kRobotStates) text.Add(in_state[state], {{"state", state}});

  // This is for each robot of which the value is known.
  const auto each = [&](const char* name, const char* help, const auto& add) {
    text.Begin(name, kGauge, help);
    for (const auto& [robot, is] : robots) add(robot, is);
  };
  const auto number = [&](const char* name, const char* help, const auto& of) {
    each(name, help, [&](std::string_view robot, const Robot& is) {
      const std::optional<double> value = of(is.agent->status);
      if (value && std::isfinite(*value)) text.Add(*value, {{"robot", robot}});
    });
  };
  each("robot_info", "1 for each robot.", [&](std::string_view robot, const Robot& is) {
    const AgentStatus& status = is.agent->status;
    text.Add(
        1, {{"robot", robot}, {"role", fleet::ToText(status.role)}, {"software", status.software}});
  });
  each("robot_state", "1 for what the robot does; of what it does not do there is none.",
       [&](std::string_view robot, const Robot& is) {
         text.Add(1, {{"robot", robot}, {"state", fleet::ToText(is.standing.state)}});
       });
  each("robot_needs_person", "1 while a person should look after it, else 0.",
       [&](std::string_view robot, const Robot& is) {
         text.Add(is.standing.needs_person ? 1 : 0, {{"robot", robot}});
       });
  constexpr double kMsPerSecond = 1000.0;
  each("robot_last_heard_timestamp_seconds", "When it was heard last, by the console's clock.",
       [&](std::string_view robot, const Robot& is) {
         text.Add(static_cast<double>(is.agent->heard_unix_ms) / kMsPerSecond, {{"robot", robot}});
       });
  each("robot_along_route_meters", "How far it is along its route.",
       [&](std::string_view robot, const Robot& is) {
         const AgentStatus& status = is.agent->status;
         if (!status.place) return;
         text.Add(status.place->along_m, {{"robot", robot}, {"route", status.route}});
       });
  number("robot_beside_route_sigma_meters", "How sure it is how far beside its route it is.",
         [](const AgentStatus& status) -> std::optional<double> {
           if (!status.place || status.place->left_sigma_m <= 0.0) return std::nullopt;
           return status.place->left_sigma_m;
         });
  number("robot_speed_meters_per_second", "How fast it is told to drive.",
         [](const AgentStatus& status) { return std::optional(status.speed_mps); });
  number(
      "robot_backlog_segments", "Segments that it taught and no server has yet.",
      [](const AgentStatus& status) { return std::optional(static_cast<double>(status.backlog)); });
  const auto ratio = [](std::optional<std::uint8_t> percent) {
    return percent ? std::optional(*percent / 100.0) : std::nullopt;
  };
  number("robot_battery_ratio", "How full its battery is.",
         [&](const AgentStatus& status) { return ratio(status.battery_percent); });
  number("robot_link_ratio", "How good its radio's link is.",
         [&](const AgentStatus& status) { return ratio(status.link_percent); });

  text.Begin("server_heard", kGauge, "1 while the route server is heard, else 0.");
  for (const auto& [name, server] : servers) {
    const bool ended = server->status.mode == exchange::AgentMode::kStopped;
    text.Add(server->silent || ended ? 0 : 1, {{"server", name}});
  }

  std::map<mission::State, int> open;
  for (const auto& [name, record] : missions_) ++open[record.last.state];
  text.Begin("missions_open", kGauge, "Missions that have not ended, of those heard of lately.");
  for (const mission::State state : kMissionStates) {
    if (!mission::HasEnded(state)) text.Add(open[state], {{"state", mission::ToString(state)}});
  }
  text.Begin("missions_total", "counter", "How often a mission came to a state.");
  for (const mission::State state : kMissionStates) {
    const auto became = became_.find(state);
    const double times = became == became_.end() ? 0.0 : static_cast<double>(became->second);
    text.Add(times, {{"state", mission::ToString(state)}});
  }
}

}  // namespace trailcast::console
