// This part of MissionRegistry does what operators command at once: it holds queues, lets them go,
// and sends robots home.
#include <fmt/format.h>

#include <algorithm>

#include "route_server/fleet/kept_mission.h"
#include "route_server/fleet/mission_registry.h"
#include "services/base/process_name.h"
#include "services/base/unix_time.h"
#include "services/mission/address.h"
#include "services/mission/orders.h"

namespace trailcast::server {
namespace {

// The mission of a robot that is sent home.
constexpr std::uint32_t kHomeWithin_s = 600;

// Such a command holds every queue, also those that are empty, until robots are told to resume.
bool SendsAllHome(const exchange::NowCommand& command) {
  return command.order == exchange::NowOrder::kHome && command.whom == exchange::NowWhom::kAll;
}

std::string SentHomeText(const exchange::NowCommand& command, std::int64_t now_unix_ms) {
  return fmt::format("sent home by {} {}, until it is told to resume",
                     WithoutProcess(command.client.value()), MomentText(now_unix_ms));
}

bool MeansMission(const exchange::NowCommand& command, const mission::Mission& mission) {
  switch (command.whom) {
    case exchange::NowWhom::kRobot:
      return command.name == mission.agent.value();
    case exchange::NowWhom::kOnRoute:
      return mission::RoutesIn(mission.orders).contains(command.name);
    case exchange::NowWhom::kAll:
      return true;
  }
  return false;
}

}  // namespace

// A cancellation voids the missions that were sent before it, even if the robot has not heard of
// them yet.
void MissionRegistry::On(const exchange::NowCommand& command, Time now, std::int64_t now_unix_ms) {
  if (mission::IsGroup(command.name)) AnswerForGroup(command);
  const NowKey key{command.client, command.number};
  if (std::exchange(commands_.Touch(key), command)) return;
  std::vector<AgentId> answered;
  for (const auto& [from, answer] : answers_) {
    if (from.second == key) answered.push_back(from.first);
  }
  for (const AgentId& agent : answered) SendHome(command, agent, now, now_unix_ms);
  if (const auto added = store_->Add(command, now_unix_ms); !added) Warn(added.error());
  HoldOrLetGo(command, now_unix_ms);
  if (command.order != exchange::NowOrder::kCancel) return;
  const std::string why =
      fmt::format("{} told it to {} before it had this mission",
                  WithoutProcess(command.client.value()), exchange::ToString(command.order));
  Drop(
      mission::State::kCancelled,
      [&](const Waiting& record) {
        return MeansMission(command, record.mission) ? std::optional(why) : std::nullopt;
      },
      now_unix_ms);
}

bool MissionRegistry::IsMeant(const exchange::NowCommand& command, const AgentId& agent) const {
  if (command.whom == exchange::NowWhom::kAll) return true;
  if (command.whom == exchange::NowWhom::kRobot) return command.name == agent.value();
  const Current* current = current_.Find(agent);
  if (current != nullptr && MeansMission(command, current->record.mission)) return true;
  const auto queue = unanswered_.find(agent);
  return queue != unanswered_.end() &&
         std::any_of(queue->second.begin(), queue->second.end(),
                     [&](const Waiting& each) { return MeansMission(command, each.mission); });
}

void MissionRegistry::HoldOrLetGo(const exchange::NowCommand& command, std::int64_t now_unix_ms) {
  std::set<AgentId> agents;
  for (const auto& [agent, queue] : unanswered_) agents.insert(agent);
  for (const auto& [agent, hold] : holds_) agents.insert(agent);
  for (const AgentId& agent : agents) {
    if (!IsMeant(command, agent)) continue;
    if (command.order == exchange::NowOrder::kResume) LetGo(agent, now_unix_ms);
    if (!unanswered_.contains(agent)) continue;
    if (command.order == exchange::NowOrder::kStop) {
      Hold(agent,
           fmt::format("stopped by {} {}, until it is released and told to resume",
                       WithoutProcess(command.client.value()), MomentText(now_unix_ms)),
           now_unix_ms);
    } else if (SendsAllHome(command)) {
      Hold(agent, SentHomeText(command, now_unix_ms), now_unix_ms, true);
    }
  }
}

std::string MissionRegistry::HeldBy(const AgentId& agent) const {
  const auto hold = holds_.find(agent);
  return hold == holds_.end() ? "" : hold->second.why;
}

void MissionRegistry::Hold(const AgentId& agent, const std::string& why, std::int64_t now_unix_ms,
                           bool stays) {
  store::MissionStore::Hold& hold = holds_[agent];
  hold = {agent, why, now_unix_ms, stays || (hold.stays && !why.empty())};
  const auto stored = store_->Put(hold);
  NoteStored(stored);
  if (!stored) Warn(stored.error());
  changed_.insert(agent);
}

void MissionRegistry::LetGo(const AgentId& agent, std::int64_t now_unix_ms) {
  if (HeldBy(agent).empty()) return;
  Hold(agent, "", now_unix_ms);
  if (Heard* heard = heard_.Find(agent)) heard->tell_at = {};
}

// The hold is on the disk before the end is. A robot repeats the end of a mission until it is
// stored, and a repeated end that is known must not hold what an operator has let go meanwhile.
void MissionRegistry::HoldAfter(const mission::Report& end, std::int64_t now_unix_ms) {
  if (!mission::HasEnded(end.state) || end.state == mission::State::kArrived) return;
  const auto queue = unanswered_.find(end.agent);
  if (queue == unanswered_.end() || !HeldBy(end.agent).empty()) return;
  const bool others_wait =
      std::any_of(queue->second.begin(), queue->second.end(),
                  [&](const Waiting& each) { return each.mission.id != end.mission; });
  const auto known = store_->Find({.agent = end.agent.value(), .id = end.mission});
  const bool is_news =
      known && !known->missions.empty() && !mission::HasEnded(known->missions.front().last.state);
  if (!others_wait || !is_news) return;
  Hold(end.agent, NotArrived(end), now_unix_ms);
}

void MissionRegistry::On(const exchange::NowAnswer& answer, Time now, std::int64_t now_unix_ms) {
  const NowKey key{answer.client, answer.number};
  if (std::exchange(answers_.Touch({answer.agent, key}), answer)) return;
  if (const auto added = store_->Add(answer); !added) Warn(added.error());
  const auto* command = commands_.Find(key);
  if (command == nullptr || !*command) return;
  SendHome(exchange::NowCommand(**command), answer.agent, now, now_unix_ms);
}

// An answer may come before its command does.
void MissionRegistry::SendHome(const exchange::NowCommand& command, const AgentId& agent, Time now,
                               std::int64_t now_unix_ms) {
  const auto* answer = answers_.Find({agent, {command.client, command.number}});
  const bool obeys = answer != nullptr && *answer && !(*answer)->refused;
  if (command.order != exchange::NowOrder::kHome || !obeys) return;
  const mission::Mission mission{.agent = agent,
                                 .id = fmt::format("{}{:016x}", kHomePrefix, command.number),
                                 .client = command.client,
                                 .orders = OrdersWithoutWay(mission::kHomeWord),
                                 .valid_for_s = kHomeWithin_s};
  const bool others_wait = unanswered_.contains(agent);
  if (!TakeFirst(mission, now, now_unix_ms)) return;
  if (!others_wait && !SendsAllHome(command)) return;
  Hold(agent, SentHomeText(command, now_unix_ms), now_unix_ms, SendsAllHome(command));
}

bool MissionRegistry::TakeFirst(const mission::Mission& mission, Time now,
                                std::int64_t now_unix_ms) {
  Take({&mission, 1}, now, now_unix_ms);
  const auto found = unanswered_.find(mission.agent);
  if (found == unanswered_.end() || found->second.back().mission.id != mission.id) return false;
  std::rotate(found->second.begin(), found->second.end() - 1, found->second.end());
  return true;
}
}  // namespace trailcast::server
