// This part of Vehicle does a fleet manager's instant actions: it tells the robot, and waits until
// the robot obeys.
#include <fmt/format.h>

#include <algorithm>

#include "services/vda5050/vehicle.h"

namespace trailcast::vda5050 {
namespace {

using exchange::NowOrder;
using std::chrono::duration_cast;
using std::chrono::milliseconds;

constexpr std::size_t kMostCommands = 4;

}  // namespace

void Vehicle::TakeInstantActions(std::string_view payload, Time now) {
  state_asked_ = true;
  const auto actions = ParseInstantActions(identity_, payload);
  if (!actions) {
    rejected_action_ = actions.error();
    return;
  }
  for (const Action& action : *actions) {
    const bool is_known = std::any_of(actions_.begin(), actions_.end(), [&](const auto& each) {
      return each.action.id == action.id;
    });
    if (is_known) continue;  // said again
    if (actions_.size() >= kMostActionStates) {
      const auto ended = std::find_if(actions_.begin(), actions_.end(), [](const auto& each) {
        return each.status == "FINISHED" || each.status == "FAILED";
      });
      actions_.erase(ended == actions_.end() ? actions_.begin() : ended);
    }
    actions_.push_back({action, "RUNNING", ""});
    Begin(action, now);
  }
}

void Vehicle::Begin(const Action& action, Time now) {
  const bool is_new = identity_.version == Version::k3_0;
  if (action.type == "cancelOrder") return BeginCancel(action, now);
  if (action.type == "startPause") return Tell(action.id, NowOrder::kPause, now);
  if (action.type == "stopPause") {
    for (Command& command : commands_) {
      if (command.order != NowOrder::kPause) continue;
      Conclude(command.action, "FAILED", "stopPause came before the robot had answered");
    }
    std::erase_if(commands_, [](const Command& each) { return each.order == NowOrder::kPause; });
    return Tell(action.id, NowOrder::kResume, now);
  }
  if (action.type == "stateRequest") return Conclude(action.id, "FINISHED", "");
  if (action.type == "factsheetRequest") {
    factsheet_asked_ = true;
    return Conclude(action.id, "FINISHED", "");
  }
  if (action.type == "clearInstantActions" && is_new) {
    ClearActions();
    return Conclude(action.id, "FINISHED", "");
  }
  rejected_action_ = Fault{.type = "INVALID_INSTANT_ACTION",
                           .description = fmt::format("'{}' is no instant action of this robot: "
                                                      "its factsheet lists them",
                                                      action.type),
                           .references = {{"actionId", action.id}}};
  Conclude(action.id, "FAILED", "this robot has no such action");
}

void Vehicle::BeginCancel(const Action& action, Time now) {
  const bool is_meant = IsActive() && (action.order.empty() || action.order == held_->order.id);
  if (!is_meant) {
    const std::string why =
        IsActive() ? fmt::format("order '{}' is active, not '{}'", held_->order.id, action.order)
                   : "no order is active";
    no_cancel_ = Fault{
        .type = "NO_ORDER_TO_CANCEL", .description = why, .references = {{"actionId", action.id}}};
    return Conclude(action.id, "FAILED", why);
  }
  if (!leg_) {  // nothing of it is on its way
    EndOrder();
    return Conclude(action.id, "FINISHED", "");
  }
  leg_->withdrawn = true;
  Tell(action.id, NowOrder::kCancel, now);
}

void Vehicle::Tell(const std::string& action, NowOrder order, Time now) {
  if (commands_.size() >= kMostCommands) {
    Conclude(commands_.front().action, "FAILED", "too many commands have come after it");
    commands_.erase(commands_.begin());
  }
  commands_.push_back(
      {.action = action,
       .order = order,
       .telling = fleet::Telling(client_, order,
                                 {{.whom = exchange::NowWhom::kRobot, .name = identity_.serial}},
                                 "by a fleet manager, over VDA 5050"),
       .began = now,
       .say_at = now});
}

void Vehicle::Conclude(const std::string& action, const char* status, const std::string& result) {
  for (ActionState& each : actions_) {
    if (action.empty() || each.action.id != action || each.status != "RUNNING") continue;
    each.status = status;
    each.result = result;
    if (each.status == "FINISHED") rejected_action_.reset();
  }
}

void Vehicle::ClearActions() {
  std::erase_if(actions_, [](const ActionState& each) {
    return each.status == "FINISHED" || each.status == "FAILED";
  });
}

void Vehicle::SeeTo(Time now) {
  std::erase_if(commands_, [&](Command& command) { return SeeTo(command, now); });
}

// Returns whether it is over.
bool Vehicle::SeeTo(Command& command, Time now) {
  const auto since = duration_cast<milliseconds>(now - command.began);
  const std::vector<fleet::RobotsWord> words = command.telling.Words();
  const fleet::RobotsWord& word = words.front();
  const bool cancels = command.order == NowOrder::kCancel;
  if (command.telling.AllAnswered(since)) {
    // A robot says that it has no mission if it has not taken the one that is meant, or has ended
    // it.
    if (word.refused && !(cancels && !RobotHasLeg())) {
      NotObeyed(command, identity_.serial + " does not obey: " + word.detail);
      return true;
    }
    if (command.order != NowOrder::kResume && Drives()) return false;  // until it stands
    Obeyed(command, word.refused ? "" : word.detail);
    return true;
  }
  if (since < kAnswerWithin || command.failed) return false;
  NotObeyed(command, fmt::format("{} did not answer within {} s and may be moving",
                                 identity_.serial, kAnswerWithin.count() / 1000));
  // A robot that is told late to go on may surprise somebody.
  return command.order == NowOrder::kResume;
}

void Vehicle::Obeyed(const Command& command, const std::string& detail) {
  disobeyed_.reset();
  if (command.order == NowOrder::kCancel && IsActive() && leg_ && leg_->withdrawn) EndOrder();
  if (command.order == NowOrder::kCancel && IsActive() && !leg_) EndOrder();
  Conclude(command.action, "FINISHED", detail);
}

void Vehicle::NotObeyed(Command& command, const std::string& why) {
  command.failed = true;
  disobeyed_ = Fault{.type = "ROBOT_DID_NOT_OBEY",
                     .level = Level::kCritical,
                     .description = why,
                     .hint = command.order == NowOrder::kResume
                                 ? "Look why it stands, and send stopPause again."
                                 : "Look at the robot: its red button stops it."};
  if (!command.action.empty()) disobeyed_->references = {{"actionId", command.action}};
  Conclude(command.action, "FAILED", why);
  const bool answered = command.telling.Words().front().answered;
  if (answered && command.order == NowOrder::kCancel && leg_) leg_->withdrawn = false;
}

}  // namespace trailcast::vda5050
