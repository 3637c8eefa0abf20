#include "services/console/fleet_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <variant>

#include "services/fleet/following_words.h"
#include "services/fleet/mission_client.h"
#include "services/fleet/now_client.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/mission/address.h"
#include "services/mission/mission.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using exchange::AgentMode;
using exchange::AgentRole;
using exchange::AgentStatus;
using fleet::RobotState;
using program::Json;
using program::Rounded;

// Returns the orders that would change something.
Json OrdersFor(RobotState state, const AgentStatus& status, bool has_mission, bool open_stop,
               const std::vector<mission::Record>& queue) {
  Json orders = Json::array();
  if (status.role != AgentRole::kFollower) return orders;
  if (state == RobotState::kStopped || open_stop) {
    orders.push_back("release");
  } else if (state == RobotState::kPaused) {
    orders.push_back("resume");
  } else if (state != RobotState::kShutDown) {
    orders.push_back("pause");
  }
  const bool is_held = state == RobotState::kStopped || state == RobotState::kPaused || open_stop;
  const bool queue_is_held = !has_mission && !is_held && !queue.empty() &&
                             queue.front().last.waits_for == mission::WaitsFor::kTurn;
  if (queue_is_held && state != RobotState::kShutDown) orders.push_back("resume");
  if (status.on_duty && status.mode == AgentMode::kTeaching) orders.push_back("end");
  if (has_mission || !queue.empty()) orders.push_back("cancel");
  if (state != RobotState::kShutDown) orders.push_back("stop");
  return orders;
}

// A change always has the name, too, which comes first and never changes.
Json Changed(const Json& from, const Json& to) {
  Json changed = Json::object();
  for (const auto& [name, value] : to.items()) {
    if (name == "name" || from.at(name) != value) changed[name] = value;
  }
  return changed;
}

std::map<std::string_view, const Json*> ByName(const Json& robots) {
  std::map<std::string_view, const Json*> by_name;
  for (const Json& robot : robots) {
    by_name.emplace(robot.at("name").get_ref<const std::string&>(), &robot);
  }
  return by_name;
}

}  // namespace

void FleetState::Handle(const exchange::Message& message, Time now, std::int64_t unix_ms) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    On(*status, now, unix_ms);
  } else if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) {
    On(*answer);
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

void FleetState::On(const AgentStatus& status, Time now, std::int64_t unix_ms) {
  Agent& agent = agents_.Touch(status.agent);
  auto stood =
      status.place ? std::optional(Stood{status.route, *status.place}) : std::move(agent.stood);
  const bool stands =
      status.mode == AgentMode::kStopped ||
      (status.hold == exchange::AgentHold::kStopped && status.mode != AgentMode::kReplaying);
  auto open_stop = stands ? std::nullopt : std::move(agent.open_stop);
  agent = {.status = status,
           .open_stop = std::move(open_stop),
           .released_at = agent.released_at,
           .stood = std::move(stood),
           .heard_at = now,
           .heard_unix_ms = unix_ms};
}

void FleetState::On(const exchange::NowAnswer& answer) {
  Agent* agent = agents_.Find(answer.agent);
  if (agent == nullptr || !agent->open_stop) return;
  const exchange::NowCommand& stop = agent->open_stop->command;
  if (answer.client == stop.client && answer.number == stop.number) agent->open_stop.reset();
}

bool FleetState::Knows(const AgentId& robot) const {
  if (mission::IsGroup(robot.value())) {
    return std::any_of(agents_.begin(), agents_.end(), [&](const auto& each) {
      return each.second.status.role == AgentRole::kFollower &&
             mission::Means(robot.value(), each.first.value());
    });
  }
  return agents_.Find(robot) != nullptr ||
         std::any_of(missions_.begin(), missions_.end(), [&](const auto& each) {
           return each.first.first == robot && each.second.last.change > 0;
         });
}

std::vector<std::string> FleetState::Robots() const {
  std::vector<std::string> robots;
  for (const auto& [name, agent] : agents_) {
    if (agent.status.role == AgentRole::kFollower) robots.push_back(name.value());
  }
  return robots;
}

std::vector<AgentId> FleetState::ServersHeard() const {
  std::vector<AgentId> servers;
  for (const auto& [name, agent] : agents_) {
    const AgentStatus& last = agent.status;
    const bool is_heard = !agent.silent && last.mode != AgentMode::kStopped;
    if (last.role == AgentRole::kServer && is_heard) servers.push_back(name);
  }
  return servers;
}

std::vector<FleetState::Known> FleetState::MayMove(Time now) const {
  std::vector<Known> known;
  for (const auto& [name, agent] : agents_) {
    const bool obeys = agent.status.role == AgentRole::kFollower;
    if (!obeys || agent.status.mode == AgentMode::kStopped) continue;
    const auto ago = std::chrono::duration_cast<std::chrono::milliseconds>(now - agent.heard_at);
    known.push_back({name, fleet::LastSeenText(agent.status, ago)});
  }
  return known;
}

void FleetState::KeepTelling(const AgentId& robot, const exchange::NowCommand& stop, Time told_at,
                             std::int64_t unix_ms) {
  Agent* agent = agents_.Find(robot);
  if (agent == nullptr || agent->status.mode == AgentMode::kStopped) return;
  if (agent->released_at && *agent->released_at >= told_at) return;
  const std::int64_t since = agent->open_stop ? agent->open_stop->since_unix_ms : unix_ms;
  agent->open_stop = {.command = stop, .since_unix_ms = since};
  // The command may have been for several robots, of which the others have answered.
  agent->open_stop->command.whom = mission::NowWhom::kRobot;
  agent->open_stop->command.name = robot.value();
}

void FleetState::Release(const AgentId& robot, Time now) {
  Agent* agent = agents_.Find(robot);
  if (agent == nullptr) return;
  agent->open_stop.reset();
  agent->released_at = now;
}

std::vector<exchange::NowCommand> FleetState::TakeOpenStops(Time now) {
  std::vector<exchange::NowCommand> stops;
  for (auto& [name, agent] : agents_) {
    if (!agent.open_stop || now < agent.open_stop->say_at) continue;
    agent.open_stop->say_at = now + kStopAgainEvery;
    stops.push_back(agent.open_stop->command);
  }
  return stops;
}

// A group's mission belongs to the robot that it is given to from then on, under the same id.
bool FleetState::IsGiven(const MissionName& name) const {
  const auto& [agent, id] = name;
  if (!mission::IsGroup(agent.value())) return false;
  return std::any_of(missions_.begin(), missions_.end(), [&id = id](const auto& known) {
    return known.first.second == id && !mission::IsGroup(known.first.first.value());
  });
}

void FleetState::TakeFromGroups(const MissionName& name) {
  const auto& [agent, id] = name;
  if (mission::IsGroup(agent.value())) return;
  const auto of_group =
      std::find_if(missions_.begin(), missions_.end(), [&id = id](const auto& known) {
        return known.first.second == id && mission::IsGroup(known.first.first.value());
      });
  if (of_group != missions_.end()) missions_.Erase(MissionName(of_group->first));
}

void FleetState::On(const mission::Report& report, std::int64_t unix_ms) {
  if (report.state == mission::State::kPutOff) return;  // it has no outcome yet
  const MissionName name{report.agent, report.mission};
  if (IsGiven(name)) return;
  TakeFromGroups(name);
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
  if (!reply.error.empty()) return;
  lacks_orders_ = false;
  if (reply.request == asked_for_missions_) missions_told_ = true;
  // The reply has the newest first. They are taken in reverse, so that the newest stays longest.
  for (auto record = reply.missions.rbegin(); record != reply.missions.rend(); ++record) {
    const MissionName name{record->mission.agent, record->mission.id};
    if (IsGiven(name)) continue;
    TakeFromGroups(name);
    const bool is_new = missions_.Find(name) == nullptr;
    mission::Record& known = missions_.Touch(name);
    const mission::Report heard = known.last;
    const std::int64_t changed_unix_ms = known.changed_unix_ms;
    known = *record;
    if (heard.change <= record->last.change) {
      // Missions that ended before this console looked do not count.
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

Result<void> FleetState::Forget(const AgentId& robot, Time now) {
  Tick(now);
  const Agent* agent = agents_.Find(robot);
  if (agent == nullptr || agent->status.role == AgentRole::kServer) {
    return Fail(ErrorCode::kNotFound, "no robot '{}' is listed", robot.value());
  }
  if (!agent->silent && agent->status.mode != AgentMode::kStopped) {
    return Fail(ErrorCode::kConflict, "{} is heard: who is there stays listed", robot.value());
  }
  if (agent->open_stop) {
    return Fail(ErrorCode::kConflict,
                "{} has not answered a stop, which is told again until it has: release it first",
                robot.value());
  }
  agents_.Erase(robot);
  gone_.push_back(robot);
  return {};
}

void FleetState::DropGone(Time now) {
  std::vector<AgentId> gone;
  const Latest latest = LatestMissions();
  for (const auto& [name, agent] : agents_) {
    const AgentStatus& last = agent.status;
    const bool stood = last.speed_mps == 0.0 && last.mode != AgentMode::kReplaying &&
                       last.mode != AgentMode::kTeaching;
    if (now < agent.heard_at + kGoneAfter || !stood || agent.open_stop) continue;
    if (last.role == AgentRole::kServer) continue;
    const auto mission = latest.find(name);
    if (mission == latest.end() || mission::HasEnded(mission->second->last.state)) {
      gone.push_back(name);
    }
  }
  for (const AgentId& name : gone) agents_.Erase(name);
  gone_.insert(gone_.end(), gone.begin(), gone.end());
}

void FleetState::Tick(Time now) {
  DropGone(now);
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
    // A route that is still being taught becomes longer, so it is asked for again.
    if (route.info && route.info->state == route::RouteState::kComplete) continue;
    if (route.asked_at && now < *route.asked_at + kAskForRouteEvery) continue;
    route.asked_at = now;
    lacking.push_back(key.route);
  }
  return lacking;
}

// Returns each robot's present or last mission. A mission that the robot has refused or not heard
// of does not count.
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
  standing.last = latest == nullptr ? nullptr : &latest->last;
  standing.state = fleet::RobotStateOf(agent.status, agent.silent, standing.last);
  const bool failed = standing.last != nullptr && standing.last->state == mission::State::kFailed;
  // Such a robot does not go on by itself.
  const bool held = standing.state == RobotState::kOffline ||
                    standing.state == RobotState::kPaused || standing.state == RobotState::kStopped;
  standing.needs_person = failed || agent.open_stop.has_value() ||
                          standing.state == RobotState::kFault ||
                          (held && standing.mission != nullptr);
  return standing;
}

Json FleetState::RobotOf(const Agent& agent, const mission::Record* latest,
                         const std::vector<mission::Record>& queue) const {
  const AgentStatus& status = agent.status;
  const auto [state, needs_person, mission, last] = StandingOf(agent, latest);
  Json robot{{"name", status.agent.value()},
             {"group", mission::GroupOf(status.agent.value())},
             {"role", fleet::ToText(status.role)},
             {"state", fleet::ToText(state)},
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
             {"battery_percent", program::OrNull(status.battery_percent)},
             {"link_percent", program::OrNull(status.link_percent)},
             {"software", status.software},
             {"follows_by", fleet::FollowingText(status)},
             {"teaches", status.mode == AgentMode::kTeaching},
             {"features", status.features},
             {"unanswered_stop_unix_ms",
              agent.open_stop ? Json(agent.open_stop->since_unix_ms) : Json(nullptr)},
             {"orders", OrdersFor(fleet::RobotStateOf(status, false, last), status,
                                  mission != nullptr, agent.open_stop.has_value(), queue)}};
  if (status.place) {
    robot["route_id"] = status.place->key.route.value();
    robot["teaching"] = fmt::format("{:x}", status.place->key.teaching.value());
    robot["along_m"] = Rounded(status.place->along_m, 100.0);
    if (status.place->left_sigma_m > 0.0) {
      robot["left_m"] = Rounded(status.place->left_m, 100.0);
      // It is never 0, by which robots say that they do not know.
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
  robot["mission"] = mission == nullptr ? Json(nullptr) : fleet::MissionJson(*mission);
  robot["queue"] = fleet::MissionsJson(queue);
  return robot;
}

std::map<AgentId, std::vector<mission::Record>> FleetState::Queues() const {
  std::map<AgentId, std::vector<mission::Record>> queues;
  for (const auto& [name, record] : missions_) {
    if (record.last.state == mission::State::kSent) queues[name.first].push_back(record);
  }
  for (auto& [robot, queue] : queues) {
    std::stable_sort(queue.begin(), queue.end(), [](const auto& one, const auto& other) {
      return one.sent_unix_ms < other.sent_unix_ms;
    });
  }
  return queues;
}

bool FleetState::Teaches(const AgentId& robot) const {
  const Agent* agent = agents_.Find(robot);
  return agent != nullptr && agent->status.mode == AgentMode::kTeaching;
}

Json FleetState::MissionsShown() const {
  if (missions_.size() == 0 && !missions_told_) return nullptr;
  std::vector<const mission::Record*> newest;
  for (const auto& [name, record] : missions_) newest.push_back(&record);
  std::stable_sort(newest.begin(), newest.end(), [](const auto* one, const auto* other) {
    return one->sent_unix_ms > other->sent_unix_ms;
  });
  newest.resize(std::min(newest.size(), kMissionsShown));
  Json missions = Json::array();
  for (const mission::Record* record : newest) missions.push_back(fleet::MissionJson(*record));
  return missions;
}

Json FleetState::Shown() const {
  const Latest latest = LatestMissions();
  std::map<AgentId, std::vector<mission::Record>> queues = Queues();
  std::map<AgentId, Json> robots;
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
      robots[name] =
          RobotOf(agent, mission == latest.end() ? nullptr : mission->second, queues[name]);
    }
  }
  const auto listed = [](std::map<AgentId, Json>& agents) {
    Json list = Json::array();
    for (auto& [name, agent] : agents) list.push_back(std::move(agent));
    return list;
  };
  Json routes = Json::array();
  for (const auto& [key, route] : routes_) {
    if (route.info) routes.push_back(fleet::RouteJson(*route.info));
  }
  return {{"robots", listed(robots)},
          {"servers", listed(servers)},
          {"routes", std::move(routes)},
          {"missions", MissionsShown()}};
}

std::string StateBody(const Json& state, std::int64_t now_unix_ms) {
  Json body = {{"now_unix_ms", now_unix_ms}};
  body.update(state);
  return program::OneLine(body);
}

std::string ChangeBody(const Json& from, const Json& state, std::int64_t now_unix_ms) {
  const auto before = ByName(from.at("robots"));
  const auto after = ByName(state.at("robots"));
  Json robots = Json::array();
  for (const auto& [name, robot] : after) {
    const auto known = before.find(name);
    if (known == before.end()) {
      robots.push_back(*robot);
    } else if (*known->second != *robot) {
      robots.push_back(Changed(*known->second, *robot));
    }
  }
  Json gone = Json::array();
  for (const auto& [name, robot] : before) {
    if (!after.contains(name)) gone.push_back(name);
  }
  Json body = {
      {"now_unix_ms", now_unix_ms}, {"robots", std::move(robots)}, {"gone", std::move(gone)}};
  for (const char* part : {"servers", "routes", "missions", "alerts"}) {
    if (state.contains(part) && from.value(part, Json()) != state.at(part)) {
      body[part] = state.at(part);
    }
  }
  return program::OneLine(body);
}

}  // namespace trailcast::console
