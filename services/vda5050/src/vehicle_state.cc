// This is the state of a vehicle, as the broker is told it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/base/text.h"
#include "services/program/json.h"
#include "services/vda5050/vehicle.h"

namespace trailcast::vda5050 {
namespace {

using exchange::AgentMode;
using program::Json;

constexpr std::size_t kMostWords = 512;
// A robot that has not answered a mission for so long is reported.
constexpr std::chrono::milliseconds kAnswersMission{5000};

const char* PowerOf(Version version) {
  return version == Version::k3_0 ? "powerSupply" : "batteryState";
}

Json StepJson(const Step& step, const char* id) {
  return {{id, step.id}, {"sequenceId", step.sequence}, {"released", step.released}};
}

Json Information(const char* type, std::string_view text, Version version) {
  return {{"infoType", type},
          {version == Version::k3_0 ? "infoDescriptor" : "infoDescription",
           PlainText(text, kMostWords)},
          {"infoLevel", "INFO"}};
}

}  // namespace

std::vector<Fault> Vehicle::Faults(Time now) const {
  std::vector<Fault> faults;
  const auto add = [&](const std::optional<Fault>& fault) {
    if (fault) faults.push_back(*fault);
  };
  if (!lost_.empty()) {
    faults.push_back(
        {.type = "LOCALIZATION_ERROR",
         .level = Level::kFatal,
         .description = lost_,
         .hint = "Bring the robot back to its path, and send a new order from there."});
  }
  if (status_.mode == AgentMode::kFault) {
    faults.push_back(
        {.type = "ROBOT_FAULT",
         .level = Level::kFatal,
         .description = status_.detail.empty() ? "its agent tells a fault" : status_.detail,
         .hint = "Look at the robot."});
  }
  add(unreachable_);
  add(disobeyed_);
  const bool is_waited_for = leg_ && !leg_->sending.last() && now - leg_->began > kAnswersMission;
  if (is_waited_for) {
    const auto outcome = leg_->sending.Outcome(kAnswersMission);
    faults.push_back({.type = "ROBOT_DOES_NOT_ANSWER",
                      .level = Level::kUrgent,
                      .description = outcome ? "" : outcome.error().message,
                      .references = {{"orderId", held_->order.id}}});
  }
  add(rejected_);
  add(no_cancel_);
  add(rejected_action_);
  return faults;
}

void Vehicle::AddOrderState(Json& state) const {
  Json nodes = Json::array();
  Json edges = Json::array();
  if (IsActive()) {
    const Order& order = held_->order;
    for (std::size_t i = held_->at + 1; i < order.nodes.size(); ++i) {
      nodes.push_back(StepJson(order.nodes[i], "nodeId"));
      edges.push_back(StepJson(order.edges[i - 1], "edgeId"));
    }
  }
  state["orderId"] = held_ ? held_->order.id : "";
  state["orderUpdateId"] = held_ ? held_->order.update : 0U;
  state["lastNodeId"] = last_node_;
  state["lastNodeSequenceId"] = held_ ? held_->order.nodes[held_->at].sequence : 0U;
  state["nodeStates"] = std::move(nodes);
  state["edgeStates"] = std::move(edges);
}

Json Vehicle::Events(Time now) const {
  const bool is_new = identity_.version == Version::k3_0;
  Json state;
  AddOrderState(state);
  state["driving"] = Drives();
  state["paused"] = IsPaused();
  // The robot stands at the end of what is released: there is no telling it in time to go on.
  state["newBaseRequest"] = IsActive() && LastReleased() + 1 < held_->order.nodes.size() &&
                            held_->at + 1 >= LastReleased();
  Json actions = Json::array();
  for (const ActionState& each : actions_) {
    Json action{{"actionId", each.action.id},
                {"actionType", each.action.type},
                {"actionStatus", each.status}};
    if (!each.result.empty()) {
      action[is_new ? "actionResult" : "resultDescription"] = PlainText(each.result, kMostWords);
    }
    actions.push_back(std::move(action));
  }
  state["actionStates"] = is_new ? Json::array() : actions;
  if (is_new) state["instantActionStates"] = std::move(actions);
  const Mode mode = ModeNow();
  state["operatingMode"] = mode == Mode::kAutomatic           ? "AUTOMATIC"
                           : mode == Mode::kManual            ? "MANUAL"
                           : mode == Mode::kTeachIn           ? (is_new ? "TEACH_IN" : "TEACHIN")
                           : mode == Mode::kStartup && is_new ? "STARTUP"
                                                              : "SERVICE";
  state["errors"] = Json::array();
  for (const Fault& fault : Faults(now)) {
    state["errors"].push_back(FaultJson(fault, identity_.version));
  }
  state["safetyState"] = {{is_new ? "activeEmergencyStop" : "eStop", "NONE"},
                          {"fieldViolation", false}};
  state[PowerOf(identity_.version)] = {{"charging", !charging_.empty()}};
  return state;
}

Json Vehicle::State(Time now) const {
  const bool is_new = identity_.version == Version::k3_0;
  Json state = Events(now);
  if (leg_ && leg_->sending.last()) {
    state["distanceSinceLastNode"] =
        program::Rounded(std::max(0.0, leg_->driven_m - leg_->from_m), 100.0);
  }
  state["velocity"] = {{"vx", program::Rounded(status_.speed_mps, 100.0)}};
  const int battery = status_.battery_percent ? *status_.battery_percent : battery_.value_or(0);
  state[PowerOf(identity_.version)][is_new ? "stateOfCharge" : "batteryCharge"] =
      std::min(battery, 100);
  Json information = Json::array();
  information.push_back(Information(
      "NOT_TOLD_BY_ROBOT",
      fmt::format("{}the emergency stop{} protective fields have the values that the gateway's "
                  "operator vouches for",
                  status_.battery_percent ? "" : "the battery, ",
                  charging_.empty() ? ", charging and" : " and"),
      identity_.version));
  if (!charging_.empty()) {
    information.push_back(Information("CHARGES", charging_, identity_.version));
  }
  if (!status_.detail.empty()) {
    information.push_back(Information("ROBOT_SAYS", status_.detail, identity_.version));
  }
  if (status_.hold == exchange::AgentHold::kStopped) {
    information.push_back(Information("STOPPED_BY_OPERATOR",
                                      "it stands until it is released ('trailcast release')",
                                      identity_.version));
  }
  state["information"] = std::move(information);
  return state;
}

}  // namespace trailcast::vda5050
