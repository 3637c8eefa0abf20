#include "services/console/fleet_state.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "services/console/src/values.h"
#include "services/exchange/servers_there.h"
#include "services/mission/mission.h"
#include "services/route/labels.h"

namespace trailcast::console {
namespace {

using exchange::AgentMode;
using exchange::AgentRole;
using exchange::AgentStatus;

// How a robot stands by an operator's word is told in words alone (agent/link/operator_hold.h).
bool SaysStopped(const std::string& detail) {
  return detail.starts_with("stopped by ") || detail.starts_with("stopped, nobody");
}
bool SaysPaused(const std::string& detail) {
  return detail.starts_with("paused by ") || detail.starts_with("released, ") ||
         detail.starts_with("its agent has started again");
}

const char* StateOf(const AgentStatus& status, bool silent) {
  if (silent) return "silent";
  if (status.mode == AgentMode::kWaiting && SaysStopped(status.detail)) return "stopped";
  if (status.mode == AgentMode::kWaiting && SaysPaused(status.detail)) return "paused";
  switch (status.mode) {
    case AgentMode::kStarting:
      return "starting";
    case AgentMode::kWaiting:
      return status.role == AgentRole::kFollower && status.detail.starts_with("free") ? "free"
                                                                                      : "waiting";
    case AgentMode::kTeaching:
      return "teaching";
    case AgentMode::kReplaying:
      return "driving";
    case AgentMode::kArrived:
      return "arrived";
    case AgentMode::kStopped:
      return "ended";
    case AgentMode::kFault:
      return "fault";
  }
  return "waiting";
}

// Coarse, so that noise is no news.
double Rounded(double value, double parts) {
  return std::isfinite(value) ? std::round(value * parts) / parts : 0.0;
}

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
  if (has_mission) orders.push_back("cancel");
  if (state != "ended") orders.push_back("stop");
  return orders;
}

const char* ToText(AgentRole role) {
  switch (role) {
    case AgentRole::kServer:
      return "server";
    case AgentRole::kScout:
      return "scout";
    case AgentRole::kFollower:
      return "follower";
    case AgentRole::kOperator:
      return "operator";
  }
  return "unknown";
}

}  // namespace

void FleetState::Handle(const exchange::Message& message, Time now, std::int64_t unix_ms) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    agents_.Touch(status->agent) = {.status = *status, .heard_at = now, .heard_unix_ms = unix_ms};
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
  if (known == nullptr) {
    lacks_orders_ = true;
    known = &missions_.Touch(name);
    known->mission.agent = report.agent;
    known->mission.id = report.mission;
    known->sent_unix_ms = unix_ms;
  }
  if (!mission::IsNewer(report, known->last)) return;
  if (known->last.state != report.state || known->last.detail != report.detail) {
    known->changed_unix_ms = unix_ms;
  }
  known->last = report;
}

void FleetState::On(const exchange::MissionReply& reply) {
  lacks_orders_ = false;
  // The newest first, and the newest is to stay longest.
  for (auto record = reply.missions.rbegin(); record != reply.missions.rend(); ++record) {
    mission::Record& known = missions_.Touch({record->mission.agent, record->mission.id});
    const mission::Report heard = known.last;
    const std::int64_t changed_unix_ms = known.changed_unix_ms;
    known = *record;
    if (heard.change <= record->last.change) continue;
    known.last = heard;
    known.changed_unix_ms = changed_unix_ms;
  }
}

void FleetState::On(const exchange::CatalogReply& reply) {
  if (!reply.error.empty()) return;
  if (!routes_.contains(reply.server) && routes_.size() >= exchange::ServersThere::kMost) return;
  routes_[reply.server] = reply.page.routes;
}

void FleetState::Sent(const mission::Mission& mission, std::int64_t unix_ms) {
  const MissionName name{mission.agent, mission.id};
  if (missions_.Find(name) != nullptr) return;
  missions_.Touch(name) = {.mission = mission,
                           .last = {.agent = mission.agent, .mission = mission.id},
                           .sent_unix_ms = unix_ms,
                           .changed_unix_ms = unix_ms};
}

void FleetState::Tick(Time now) {
  const auto share = std::chrono::milliseconds(10) * static_cast<int>(agents_.size());
  std::vector<AgentId> names;
  for (const auto& [name, agent] : agents_) names.push_back(name);
  for (const AgentId& name : names) {
    Agent& agent = *agents_.Find(name);
    agent.silent = agent.gone || now > agent.heard_at + kSilentAfter + 3 * share;
  }
}

// What it does, or did last; of what it has refused or has not heard of it does nothing.
const mission::Record* FleetState::LatestOf(const AgentId& robot) const {
  const mission::Record* latest = nullptr;
  for (const auto& [name, record] : missions_) {
    if (name.first != robot || record.last.change == 0) continue;
    if (record.last.state == mission::State::kRefused) continue;
    if (latest == nullptr || record.sent_unix_ms > latest->sent_unix_ms) latest = &record;
  }
  return latest;
}

std::string FleetState::Json() const {
  using console::Json;
  std::map<route::RouteKey, const route::RouteInfo*> by_key;
  std::map<std::string, Json> routes;
  for (const auto& [server, infos] : routes_) {
    for (const route::RouteInfo& info : infos) {
      by_key.emplace(info.key, &info);
      routes.emplace(info.key.route.value(), Json{{"name", info.name},
                                                  {"route", info.key.route.value()},
                                                  {"revision", info.revision.value()},
                                                  {"state", route::StateText(info)},
                                                  {"length_m", Rounded(info.length_m, 100.0)},
                                                  {"description", info.description}});
    }
  }
  std::map<AgentId, const Agent*> agents;
  for (const auto& [name, agent] : agents_) agents.emplace(name, &agent);

  Json robots = Json::array();
  Json servers = Json::array();
  for (const auto& [name, agent] : agents) {
    const AgentStatus& status = agent->status;
    const bool ended = status.mode == AgentMode::kStopped;
    const std::string state = StateOf(status, agent->silent && !ended);
    Json heard_last = agent->silent ? Json(agent->heard_unix_ms) : Json(nullptr);
    if (status.role == AgentRole::kServer) {
      servers.push_back({{"name", name.value()},
                         {"heard", !agent->silent && !ended},
                         {"last_heard_unix_ms", std::move(heard_last)},
                         {"detail", status.detail}});
      continue;
    }
    if (status.role == AgentRole::kOperator) continue;
    const mission::Record* latest = LatestOf(name);
    const bool failed = latest != nullptr && latest->last.state == mission::State::kFailed;
    const mission::Record* mission =
        latest != nullptr && mission::HasEnded(latest->last.state) ? nullptr : latest;
    const bool fails = state == "fault" || failed || (state == "silent" && mission != nullptr);
    Json robot{{"name", name.value()},
               {"role", ToText(status.role)},
               {"state", state},
               {"detail", status.detail},
               {"needs_person", fails},
               {"heard", !agent->silent},
               {"last_heard_unix_ms", std::move(heard_last)},
               {"route", status.route},
               {"segment", status.segment},
               {"segments", status.segments},
               {"progress", Rounded(status.progress, 1000.0)},
               {"along_m", nullptr},
               {"length_m", nullptr},
               {"speed_mps", Rounded(status.speed_mps, 100.0)},
               {"mission", mission == nullptr ? Json(nullptr) : RecordValue(*mission)},
               {"orders", OrdersFor(StateOf(status, false), status, mission != nullptr)}};
    if (status.place) {
      robot["along_m"] = Rounded(status.place->along_m, 100.0);
      const auto info = by_key.find(status.place->key);
      if (info != by_key.end()) robot["length_m"] = Rounded(info->second->length_m, 100.0);
    }
    robots.push_back(std::move(robot));
  }

  std::vector<const mission::Record*> newest;
  for (const auto& [name, record] : missions_) newest.push_back(&record);
  std::stable_sort(newest.begin(), newest.end(), [](const auto* one, const auto* other) {
    return one->sent_unix_ms > other->sent_unix_ms;
  });
  Json missions = Json::array();
  for (const mission::Record* record : newest) {
    if (missions.size() >= kMissionsShown) break;
    missions.push_back(RecordValue(*record));
  }
  Json listed = Json::array();
  for (auto& [id, route] : routes) listed.push_back(std::move(route));
  std::stable_sort(listed.begin(), listed.end(), [](const Json& one, const Json& other) {
    return one["name"].get_ref<const std::string&>() < other["name"].get_ref<const std::string&>();
  });
  return Text({{"robots", std::move(robots)},
               {"servers", std::move(servers)},
               {"routes", std::move(listed)},
               {"missions", std::move(missions)}});
}

}  // namespace trailcast::console
