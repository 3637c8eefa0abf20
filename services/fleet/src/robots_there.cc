#include "services/fleet/robots_there.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>
#include <vector>

#include "services/fleet/following_words.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using exchange::AgentHold;
using exchange::AgentMode;
using exchange::AgentStatus;
using program::Rounded;
using program::RoundedOrNull;

std::string Says(const AgentStatus& status) {
  const std::string follows_by = FollowingText(status);
  if (status.detail.empty() || follows_by.empty()) return status.detail + follows_by;
  return fmt::format("{}; {}", status.detail, follows_by);
}

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

std::string DoingOf(const AgentStatus& status) {
  return status.hold == AgentHold::kNone || status.mode == AgentMode::kReplaying
             ? ToText(status.mode)
             : HoldText(status.hold);
}

std::string Percent(std::optional<std::uint8_t> value) {
  return value ? fmt::format("{} %", *value) : "-";
}

program::Json JsonOf(const AgentStatus& status) {
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
          {"mode", ToText(status.mode)},
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
          {"detail", status.detail}};
}

}  // namespace

const char* ToText(AgentMode mode) {
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
      return "ended";
    case AgentMode::kFault:
      return "fault";
  }
  return "waiting";
}

void RobotsThere::Hear(const exchange::Message& message) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    const bool is_robot = status->role == exchange::AgentRole::kFollower ||
                          status->role == exchange::AgentRole::kScout;
    if (!is_robot || (!robots_.contains(status->agent) && robots_.size() >= kMost)) return;
    robots_[status->agent] = *status;
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    const auto robot = robots_.find(gone->agent);
    if (robot != robots_.end() && robot->second.instance == gone->instance) robots_.erase(robot);
  }
}

std::string RobotsThere::Text() const {
  if (robots_.empty()) return "";
  constexpr const char* kLine = "{:<16} {:<9} {:<16} {:>8} {:>8} {:>6} {:>6} {:<8} {}\n";
  std::string text = fmt::format(kLine, "ROBOT", "DOES", "ROUTE", "ALONG", "BESIDE", "BATT",
                                 "RADIO", "VERSION", "SAYS");
  for (const auto& [name, status] : robots_) {
    std::string along = "-";
    std::string beside = "-";
    if (status.place) along = fmt::format("{:.1f} m", status.place->along_m);
    if (status.place && status.place->left_sigma_m > 0.0) {
      beside = fmt::format("±{:.0f} cm", 100.0 * status.place->left_sigma_m);
    }
    text +=
        fmt::format(kLine, name.value(), DoingOf(status), status.route.empty() ? "-" : status.route,
                    along, beside, Percent(status.battery_percent), Percent(status.link_percent),
                    status.software.empty() ? "-" : status.software, Says(status));
  }
  return text;
}

nlohmann::ordered_json RobotsThere::Json() const {
  auto list = program::Json::array();
  for (const auto& [name, status] : robots_) list.push_back(JsonOf(status));
  return list;
}

}  // namespace trailcast::fleet
