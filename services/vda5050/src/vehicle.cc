#include "services/vda5050/vehicle.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace trailcast::vda5050 {
namespace {

using exchange::AgentMode;
using exchange::AgentStatus;
using exchange::NowOrder;
using mission::State;
using std::chrono::milliseconds;

constexpr milliseconds kTellAgain{100};
constexpr milliseconds kTellOnAgain{500};  // what was not answered in time

}  // namespace

Vehicle::Vehicle(Identity identity, AgentId client, std::optional<std::uint8_t> battery)
    : identity_(std::move(identity)), client_(std::move(client)), battery_(battery) {}

void Vehicle::Hear(const exchange::Message& message, Time now) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    if (status->agent == robot()) On(*status, now);
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    if (gone->agent == robot() && gone->instance == status_.instance) gone_ = true;
  } else if (const auto* report = std::get_if<mission::Report>(&message)) {
    if (report->agent == robot()) On(*report, now);
  } else if (const auto* reply = std::get_if<exchange::MissionReply>(&message)) {
    On(*reply, now);
  }
  if (leg_) (void)leg_->sending.Hear(message);
  for (Command& command : commands_) command.telling.Hear(message);
}

void Vehicle::On(const AgentStatus& status, Time now) {
  status_ = status;
  heard_ = true;
  gone_ = false;
  heard_at_ = now;
  if (!status.place) return;
  stood_ = network::Place{status.route, status.place->along_m};
  const bool on_mission = RobotHasLeg() || !foreign_.empty();
  if (status.mode == AgentMode::kReplaying && on_mission) lost_.clear();
}

// The servers' word on which missions have not ended: that one has may not have been heard here.
void Vehicle::On(const exchange::MissionReply& reply, Time now) {
  if (reply.client != client_ || reply.next != 0 || !reply.error.empty()) return;
  const bool goes_on =
      std::any_of(reply.missions.begin(), reply.missions.end(), [&](const mission::Record& each) {
        return each.mission.agent == robot() && each.mission.id == foreign_;
      });
  if (!goes_on) foreign_.clear();
  for (const mission::Record& record : reply.missions) {
    if (record.mission.agent == robot()) On(record.last, now);
  }
}

bool Vehicle::IsOwn(const std::string& mission) const {
  return std::find(own_.begin(), own_.end(), mission) != own_.end();
}

void Vehicle::On(const mission::Report& report, Time now) {
  if (report.change == 0) return;  // a server's word: the robot has not taken it
  const bool ended = mission::HasEnded(report.state);
  if (!IsOwn(report.mission)) {
    if (!ended) {
      foreign_ = report.mission;
    } else if (foreign_ == report.mission) {
      foreign_.clear();
    }
    return;
  }
  if (!ended) foreign_.clear();  // a robot does one mission at a time
  // It has reached the robot after the order was cancelled.
  const bool is_stale = !leg_ || leg_->sending.mission().id != report.mission;
  const bool is_told = std::any_of(commands_.begin(), commands_.end(), [](const Command& each) {
    return each.order == NowOrder::kCancel;
  });
  if (is_stale && !ended && !is_told) Tell("", NowOrder::kCancel, now);
}

Vehicle::Mode Vehicle::ModeNow() const {
  if (status_.mode == AgentMode::kTeaching || status_.role == exchange::AgentRole::kScout) {
    return Mode::kTeachIn;
  }
  if (status_.mode == AgentMode::kStarting && !IsActive()) return Mode::kStartup;
  if (status_.mode == AgentMode::kFault) return IsActive() ? Mode::kAutomatic : Mode::kService;
  if (!foreign_.empty() || (!status_.on_duty && !IsActive())) return Mode::kManual;
  return Mode::kAutomatic;
}

Connection Vehicle::ConnectionAt(Time now) const {
  if (!heard_) return Connection::kOffline;
  if (status_.mode == AgentMode::kStopped) return Connection::kOffline;
  if (gone_ || now - heard_at_ > kSilentAfter) return Connection::kBroken;
  return Connection::kOnline;
}

bool Vehicle::Drives() const { return std::abs(status_.speed_mps) > 0.0; }

bool Vehicle::IsPaused() const {
  if (status_.hold != exchange::AgentHold::kNone) return true;
  return leg_ && leg_->sending.last() && leg_->sending.last()->state == State::kPaused;
}

std::size_t Vehicle::LastReleased() const {
  std::size_t last = 0;
  const auto& nodes = held_->order.nodes;
  while (last + 1 < nodes.size() && nodes[last + 1].released) ++last;
  return last;
}

std::vector<exchange::Message> Vehicle::Due(Time now) {
  std::vector<exchange::Message> due;
  for (Command& command : commands_) {
    if (now < command.say_at) continue;
    command.say_at = now + (command.failed ? kTellOnAgain : kTellAgain);
    for (const exchange::NowCommand& each : command.telling.commands()) due.emplace_back(each);
  }
  if (leg_ && !leg_->withdrawn && now >= leg_->say_at) {
    leg_->say_at = now + leg_->sending.SayAgain();
    due.emplace_back(leg_->sending.mission());
  }
  return due;
}

}  // namespace trailcast::vda5050
