#include "services/console/fleet_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <variant>

#include "services/console/src/api/values.h"
#include "services/console/src/robot_state.h"
#include "services/fleet/mission_client.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/mission/mission.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using exchange::AgentMode;
using exchange::AgentRole;
using exchange::AgentStatus;

// What an operator's word would change.
Json OrdersFor(std::string_view state, const AgentStatus& status, bool has_mission) {
  Json orders = Json::array();
  if (status.role != AgentRole::kFollower) return orders;
  if (state == "stopped") {
    orders.push_back("release");
  } else if (state == "paused") {
    orders.push_back("resume");
  } else if (state != "ended") {
    orders.push_back("pause");
  }
  if (status.on_duty && status.mode == AgentMode::kTeaching) orders.push_back("end");
  if (has_mission) orders.push_back("cancel");
  if (state != "ended") orders.push_back("stop");
  return orders;
}

std::string Object(const StateParts::Members& members) {
  std::string text;
  for (const auto& [name, value] : members) {
    text += fmt::format("{}\"{}\":{}", text.empty() ? '{' : ',', name, value);
  }
  return text + "}";
}

// With the name, which is the first and stays.
StateParts::Members Changed(const StateParts::Members& from, const StateParts::Members& to) {
  StateParts::Members changed{to.front()};
  for (std::size_t i = 1; i < to.size(); ++i) {
    if (from[i] != to[i]) changed.push_back(to[i]);
  }
  return changed;
}

}  // namespace

void FleetState::Handle(const exchange::Message& message, Time now, std::int64_t unix_ms) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    Agent& agent = agents_.Touch(status->agent);
    auto stood = status->place ? std::optional(Stood{status->route, *status->place})
                               : std::move(agent.stood);
    agent = {
        .status = *status, .stood = std::move(stood), .heard_at = now, .heard_unix_ms = unix_ms};
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    Agent* agent = agents_.Find(gone->agent);
    if (agent != nullptr && agent->status.instance == gone->instance) agent->gone = true;
  } else if (const auto* report = std::get_if<mission::Report>(&message)) {
    On(*report, unix_ms);
  } else if (const auto* missions = std::get_if<exchange::MissionReply>(&message)) {
    if (missions->client == self_) On(*missions);
  } else if (const auto* routes = std::get_if<exchange::CatalogReply>(&message)) {
    if (routes->client == self_) On(*routes);
  }
}

void FleetState::On(const mission::Report& report, std::int64_t unix_ms) {
  const MissionName name{report.agent, report.mission};
  mission::Record* known = missions_.Find(name);
  const bool is_new = known == nullptr;
  if (is_new) {
    lacks_orders_ = true;
    known = &missions_.Touch(name);
    known->mission.agent = report.agent;
    known->mission.id = report.mission;
    known->sent_unix_ms = unix_ms;
  }
  const bool newer = mission::IsNewer(report, known->last);
  if (is_new || (newer && report.state != known->last.state)) ++became_[report.state];
  if (!newer) return;
  if (known->last.state != report.state || known->last.detail != report.detail) {
    known->changed_unix_ms = unix_ms;
  }
  known->last = report;
}

void FleetState::On(const exchange::MissionReply& reply) {
  lacks_orders_ = false;
  if (reply.request == asked_for_missions_ && reply.error.empty()) missions_told_ = true;
  // The newest first, and the newest is to stay longest.
  for (auto record = reply.missions.rbegin(); record != reply.missions.rend(); ++record) {
    const MissionName name{record->mission.agent, record->mission.id};
    const bool is_new = missions_.Find(name) == nullptr;
    mission::Record& known = missions_.Touch(name);
    const mission::Report heard = known.last;
    const std::int64_t changed_unix_ms = known.changed_unix_ms;
    known = *record;
    if (heard.change <= record->last.change) {
      // What was over before this console looked is history.
      if (!is_new && heard.state != record->last.state) ++became_[record->last.state];
      continue;
    }
    known.last = heard;
    known.changed_unix_ms = changed_unix_ms;
  }
}

void FleetState::On(const exchange::CatalogReply& reply) {
  for (const route::RouteInfo& info : reply.page.routes) {
    if (const auto known = routes_.find(info.key); known != routes_.end())
      known->second.info = info;
  }
}

void FleetState::Sent(const mission::Mission& mission, std::int64_t unix_ms) {
  const MissionName name{mission.agent, mission.id};
  if (missions_.Find(name) != nullptr) return;
  ++became_[mission::State::kSent];
  missions_.Touch(name) = {.mission = mission,
                           .last = {.agent = mission.agent, .mission = mission.id},
                           .sent_unix_ms = unix_ms,
                           .changed_unix_ms = unix_ms};
}

void FleetState::Tick(Time now) {
  const auto share = std::chrono::milliseconds(10) * static_cast<int>(agents_.size());
  std::set<route::RouteKey> used;
  for (auto& [name, agent] : agents_) {
    agent.silent = agent.gone || now > agent.heard_at + kSilentAfter + 3 * share;
    if (agent.status.place) used.insert(agent.status.place->key);
  }
  std::erase_if(routes_, [&](const auto& route) { return !used.contains(route.first); });
  for (const route::RouteKey& key : used) routes_.try_emplace(key);
}

std::vector<RouteId> FleetState::TakeLackingRoutes(Time now) {
  std::vector<RouteId> lacking;
  for (auto& [key, route] : routes_) {
    if (lacking.size() >= kMostAskedFor) break;
    // One that is still being taught becomes longer.
    if (route.info && route.info->state == route::RouteState::kComplete) continue;
    if (route.asked_at && now < *route.asked_at + kAskForRouteEvery) continue;
    route.asked_at = now;
    lacking.push_back(key.route);
  }
  return lacking;
}

// What each robot does, or did last; of what it has refused or has not heard of it does nothing.
FleetState::Latest FleetState::LatestMissions() const {
  Latest latest;
  for (const auto& [name, record] : missions_) {
    if (record.last.change == 0 || record.last.state == mission::State::kRefused) continue;
    const mission::Record*& of_robot = latest[name.first];
    if (of_robot == nullptr || record.sent_unix_ms > of_robot->sent_unix_ms) of_robot = &record;
  }
  return latest;
}

FleetState::Standing FleetState::StandingOf(const Agent& agent, const mission::Record* latest) {
  Standing standing;
  const bool has_ended = latest != nullptr && mission::HasEnded(latest->last.state);
  standing.mission = has_ended ? nullptr : latest;
  const bool on_mission = standing.mission != nullptr;
  const bool ended = agent.status.mode == AgentMode::kStopped;
  standing.state = RobotState(agent.status, agent.silent && !ended, on_mission);
  const bool failed = latest != nullptr && latest->last.state == mission::State::kFailed;
  standing.needs_person =
      failed || standing.state == "fault" || (standing.state == "silent" && on_mission);
  return standing;
}

StateParts::Members FleetState::MembersOf(const Agent& agent, const mission::Record* latest) const {
  using console::Json;
  const AgentStatus& status = agent.status;
  const auto [state, needs_person, mission] = StandingOf(agent, latest);
  const auto percent = [](std::optional<std::uint8_t> value) {
    return value ? Json(*value) : Json(nullptr);
  };
  Json robot{{"name", status.agent.value()},
             {"role", ToText(status.role)},
             {"state", state},
             {"detail", status.detail},
             {"needs_person", needs_person},
             {"heard", !agent.silent},
             {"last_heard_unix_ms", agent.silent ? Json(agent.heard_unix_ms) : Json(nullptr)},
             {"route", status.route},
             {"segment", status.segment},
             {"segments", status.segments},
             {"progress", Rounded(status.progress, 1000.0)},
             {"route_id", ""},
             {"teaching", ""},
             {"along_m", nullptr},
             {"length_m", nullptr},
             {"left_m", nullptr},
             {"left_sigma_m", nullptr},
             {"stood", nullptr},
             {"speed_mps", Rounded(status.speed_mps, 100.0)},
             {"on_duty", status.on_duty},
             {"battery_percent", percent(status.battery_percent)},
             {"link_percent", percent(status.link_percent)},
             {"software", status.software},
             {"teaches", status.mode == AgentMode::kTeaching},
             {"features", status.features},
             {"orders", OrdersFor(RobotState(status, false, mission != nullptr), status,
                                  mission != nullptr)}};
  if (status.place) {
    robot["route_id"] = status.place->key.route.value();
    robot["teaching"] = fmt::format("{:x}", status.place->key.teaching.value());
    robot["along_m"] = Rounded(status.place->along_m, 100.0);
    if (status.place->left_sigma_m > 0.0) {
      robot["left_m"] = Rounded(status.place->left_m, 100.0);
      // Never 0, which is how robots say that they do not know.
      robot["left_sigma_m"] = std::max(0.01, Rounded(status.place->left_sigma_m, 100.0));
    }
    const auto route = routes_.find(status.place->key);
    if (route != routes_.end() && route->second.info) {
      robot["length_m"] = Rounded(route->second.info->length_m, 100.0);
    }
  }
  if (!status.place && agent.stood) {
    const auto& [route, place] = *agent.stood;
    robot["stood"] = {{"route", route},
                      {"route_id", place.key.route.value()},
                      {"teaching", fmt::format("{:x}", place.key.teaching.value())},
                      {"along_m", Rounded(place.along_m, 100.0)}};
  }
  StateParts::Members members;
  for (const auto& [name, value] : robot.items()) members.emplace_back(name, Text(value));
  members.emplace_back("mission", mission == nullptr ? "null" : fleet::MissionJson(*mission));
  return members;
}

bool FleetState::Teaches(const AgentId& robot) const {
  const Agent* agent = agents_.Find(robot);
  return agent != nullptr && agent->status.mode == AgentMode::kTeaching;
}

std::string FleetState::MissionsJson() const {
  if (missions_.size() == 0 && !missions_told_) return "null";
  std::vector<const mission::Record*> newest;
  for (const auto& [name, record] : missions_) newest.push_back(&record);
  std::stable_sort(newest.begin(), newest.end(), [](const auto* one, const auto* other) {
    return one->sent_unix_ms > other->sent_unix_ms;
  });
  newest.resize(std::min(newest.size(), kMissionsShown));
  std::vector<std::string> missions;
  for (const mission::Record* record : newest) missions.push_back(fleet::MissionJson(*record));
  return program::JsonList(missions);
}

StateParts FleetState::Parts() const {
  using console::Json;
  StateParts parts;
  const Latest latest = LatestMissions();
  std::map<AgentId, Json> servers;
  for (const auto& [name, agent] : agents_) {
    const bool ended = agent.status.mode == AgentMode::kStopped;
    if (agent.status.role == AgentRole::kServer) {
      servers[name] = {
          {"name", name.value()},
          {"heard", !agent.silent && !ended},
          {"last_heard_unix_ms", agent.silent ? Json(agent.heard_unix_ms) : Json(nullptr)},
          {"detail", agent.status.detail}};
    } else if (agent.status.role != AgentRole::kOperator) {
      const auto mission = latest.find(name);
      parts.robots[name.value()] =
          MembersOf(agent, mission == latest.end() ? nullptr : mission->second);
    }
  }
  Json listed = Json::array();
  for (auto& [name, server] : servers) listed.push_back(std::move(server));
  parts.servers = Text(listed);
  std::vector<std::string> routes;
  for (const auto& [key, route] : routes_) {
    if (route.info) routes.push_back(fleet::RouteJson(*route.info));
  }
  parts.routes = program::JsonList(routes);
  parts.missions = MissionsJson();
  return parts;
}

std::string WholeJson(const StateParts& parts, std::int64_t now_unix_ms) {
  std::vector<std::string> robots;
  for (const auto& [name, members] : parts.robots) robots.push_back(Object(members));
  return fmt::format(
      "{{\"now_unix_ms\":{},\"robots\":{},\"servers\":{},\"routes\":{},\"missions\":{}}}",
      now_unix_ms, program::JsonList(robots), parts.servers, parts.routes, parts.missions);
}

std::string ChangeJson(const StateParts& from, const StateParts& parts, std::int64_t now_unix_ms) {
  std::vector<std::string> robots;
  std::vector<std::string> gone;
  for (const auto& [name, robot] : parts.robots) {
    const auto known = from.robots.find(name);
    if (known == from.robots.end()) {
      robots.push_back(Object(robot));
    } else if (known->second != robot) {
      robots.push_back(Object(Changed(known->second, robot)));
    }
  }
  for (const auto& [name, robot] : from.robots) {
    if (!parts.robots.contains(name)) gone.push_back(program::JsonText(name));
  }
  std::string text = fmt::format("{{\"now_unix_ms\":{},\"robots\":{},\"gone\":{}", now_unix_ms,
                                 program::JsonList(robots), program::JsonList(gone));
  const auto add = [&](const char* name, const std::string& was, const std::string& is) {
    if (was != is) text += fmt::format(",\"{}\":{}", name, is);
  };
  add("servers", from.servers, parts.servers);
  add("routes", from.routes, parts.routes);
  add("missions", from.missions, parts.missions);
  return text + "}";
}

}  // namespace trailcast::console
