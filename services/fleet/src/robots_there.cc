#include "services/fleet/robots_there.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>
#include <vector>

#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using exchange::AgentHold;
using exchange::AgentMode;
using exchange::AgentStatus;

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

std::string JsonOf(std::optional<std::uint8_t> value) {
  return value ? std::to_string(*value) : "null";
}

std::string JsonOf(const AgentStatus& status) {
  std::string place = "null";
  if (status.place) {
    const bool sure = status.place->left_sigma_m > 0.0;
    place =
        fmt::format("{{\"route\": {}, \"along_m\": {:.2f}, \"left_m\": {}, \"left_sigma_m\": {}}}",
                    program::JsonText(status.place->key.route.value()), status.place->along_m,
                    sure ? fmt::format("{:.3f}", status.place->left_m) : "null",
                    sure ? fmt::format("{:.3f}", status.place->left_sigma_m) : "null");
  }
  return fmt::format(
      "{{\"robot\": {}, \"mode\": \"{}\", \"hold\": \"{}\", \"on_duty\": {}, \"route\": {}, "
      "\"progress\": {:.3f}, \"speed_mps\": {:.3f}, \"place\": {}, \"battery_percent\": {}, "
      "\"link_percent\": {}, \"software\": {}, \"detail\": {}}}",
      program::JsonText(status.agent.value()), ToText(status.mode), HoldText(status.hold),
      status.on_duty, program::JsonText(status.route), status.progress, status.speed_mps, place,
      JsonOf(status.battery_percent), JsonOf(status.link_percent),
      program::JsonText(status.software), program::JsonText(status.detail));
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
                    status.software.empty() ? "-" : status.software, status.detail);
  }
  return text;
}

std::string RobotsThere::Json() const {
  std::string text = "[";
  for (const auto& [name, status] : robots_) {
    text += (text.size() == 1 ? "\n  " : ",\n  ") + JsonOf(status);
  }
  return text + (robots_.empty() ? "]\n" : "\n]\n");
}

}  // namespace trailcast::fleet
