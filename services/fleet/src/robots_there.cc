#include "services/fleet/robots_there.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "services/fleet/following_words.h"
#include "services/fleet/now_client.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using exchange::AgentHold;
using exchange::AgentMode;
using exchange::AgentStatus;
using program::Rounded;
using program::RoundedOrNull;

const char* HoldText(AgentHold hold) {
  switch (hold) {
    case AgentHold::kNone:
      return "none";
    case AgentHold::kPaused:
      return "paused";
    case AgentHold::kStopped:
      break;
  }
  return "stopped";
}

std::string Percent(std::optional<std::uint8_t> value) {
  return value ? fmt::format("{} %", *value) : "-";
}

const char* ModeText(AgentMode mode) {
  switch (mode) {
    case AgentMode::kStarting:
      return "starting";
    case AgentMode::kWaiting:
      return "waiting";
    case AgentMode::kTeaching:
      return "teaching";
    case AgentMode::kReplaying:
      return "driving";
    case AgentMode::kArrived:
      return "arrived";
    case AgentMode::kStopped:
      return "shut down";
    case AgentMode::kFault:
      return "fault";
  }
  return "waiting";
}

}  // namespace

std::string RobotsThere::DetailOf(const Robot& robot) {
  const bool on_mission = robot.mission && !mission::HasEnded(robot.mission->last.state);
  if (robot.heard || !on_mission) return robot.status.detail;
  return LastKnownText(*robot.mission);
}

std::string RobotsThere::Says(const Robot& robot) {
  const std::string follows_by = FollowingText(robot.status);
  const std::string detail = DetailOf(robot);
  return detail.empty() || follows_by.empty() ? detail + follows_by : detail + "; " + follows_by;
}

RobotState RobotsThere::StateOf(const Robot& robot) {
  return RobotStateOf(robot.status, !robot.heard, robot.mission ? &robot.mission->last : nullptr);
}

program::Json RobotsThere::JsonOf(const Robot& robot) {
  const AgentStatus& status = robot.status;
  program::Json place;
  if (status.place) {
    const auto if_sure = [&](double value) {
      return status.place->left_sigma_m > 0.0 ? std::optional(value) : std::nullopt;
    };
    place = {{"route", status.place->key.route.value()},
             {"along_m", Rounded(status.place->along_m, 100.0)},
             {"left_m", RoundedOrNull(if_sure(status.place->left_m), 1000.0)},
             {"left_sigma_m", RoundedOrNull(if_sure(status.place->left_sigma_m), 1000.0)}};
  }
  return {{"robot", status.agent.value()},
          {"state", ToText(StateOf(robot))},
          {"heard", robot.heard},
          {"mode", ModeText(status.mode)},
          {"hold", HoldText(status.hold)},
          {"on_duty", status.on_duty},
          {"route", status.route},
          {"progress", Rounded(status.progress, 1000.0)},
          {"speed_mps", Rounded(status.speed_mps, 1000.0)},
          {"place", std::move(place)},
          {"battery_percent", program::OrNull(status.battery_percent)},
          {"link_percent", program::OrNull(status.link_percent)},
          {"software", status.software},
          {"follows_by", FollowingText(status)},
          {"detail", DetailOf(robot)}};
}

RobotsThere::Robot* RobotsThere::Known(const AgentId& name) {
  if (!robots_.contains(name) && robots_.size() >= kMost) return nullptr;
  Robot& robot = robots_[name];
  robot.status.agent = name;
  return &robot;
}

void RobotsThere::Hear(const exchange::Message& message) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    const bool is_robot = status->role == exchange::AgentRole::kFollower ||
                          status->role == exchange::AgentRole::kScout;
    Robot* robot = is_robot ? Known(status->agent) : nullptr;
    if (robot == nullptr) return;
    robot->status = *status;
    robot->heard = true;
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    const auto robot = robots_.find(gone->agent);
    if (robot == robots_.end() || robot->second.status.instance != gone->instance) return;
    robot->second.heard = false;
  } else if (const auto* reply = std::get_if<exchange::MissionReply>(&message)) {
    Note(*reply);
  }
}

// The newest mission comes first. A robot does not do a mission that it has refused or not heard
// of.
void RobotsThere::Note(const exchange::MissionReply& reply) {
  for (const mission::Record& record : reply.missions) {
    if (record.last.change == 0 || record.last.state == mission::State::kRefused) continue;
    const bool has_ended = mission::HasEnded(record.last.state);
    const bool known = robots_.contains(record.mission.agent);
    if (!known && has_ended) continue;  // such a robot may be gone
    Robot* robot = Known(record.mission.agent);
    if (robot == nullptr) continue;
    if (!robot->mission || record.sent_unix_ms > robot->mission->sent_unix_ms) {
      robot->mission = record;
    }
  }
}

bool RobotsThere::any_heard() const {
  return std::any_of(robots_.begin(), robots_.end(),
                     [](const auto& each) { return each.second.heard; });
}

std::string RobotsThere::Text() const {
  if (robots_.empty()) return "";
  constexpr const char* kLine = "{:<16} {:<9} {:<16} {:>8} {:>8} {:>6} {:>6} {:<8} {}\n";
  std::string text = fmt::format(kLine, "ROBOT", "STATE", "ROUTE", "ALONG", "BESIDE", "BATT",
                                 "RADIO", "VERSION", "SAYS");
  for (const auto& [name, robot] : robots_) {
    const AgentStatus& status = robot.status;
    std::string along = "-";
    std::string beside = "-";
    if (status.place) along = fmt::format("{:.1f} m", status.place->along_m);
    if (status.place && status.place->left_sigma_m > 0.0) {
      beside = fmt::format("±{:.0f} cm", 100.0 * status.place->left_sigma_m);
    }
    text += fmt::format(kLine, name.value(), ToText(StateOf(robot)),
                        status.route.empty() ? "-" : status.route, along, beside,
                        Percent(status.battery_percent), Percent(status.link_percent),
                        status.software.empty() ? "-" : status.software, Says(robot));
  }
  return text;
}

nlohmann::ordered_json RobotsThere::Json() const {
  auto list = program::Json::array();
  for (const auto& [name, robot] : robots_) list.push_back(JsonOf(robot));
  return list;
}

}  // namespace trailcast::fleet
