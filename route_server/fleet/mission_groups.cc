// This part of MissionRegistry gives missions of groups to robots that are free, and takes missions
// for several.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "route_server/fleet/kept_mission.h"
#include "route_server/fleet/mission_registry.h"
#include "services/mission/address.h"
#include "services/mission/orders.h"

namespace trailcast::server {

void MissionRegistry::TakeForAll(const mission::Mission& mission,
                                 const std::vector<std::string>& addressed, Time now,
                                 std::int64_t now_unix_ms) {
  std::vector<mission::Mission> missions;
  for (const std::string& each : addressed) {
    mission::Mission copy = mission;
    copy.agent = AgentId(each);
    auto taken = AsTaken(std::move(copy));
    if (!taken) return Say(PutOff(mission, taken.error().message));
    missions.push_back(*std::move(taken));
  }
  auto stored = store_->AddAll(missions, now_unix_ms);
  if (!stored) {
    if (told_.IsDue(stored.error().message, now)) Warn(stored.error());
    return Say(PutOff(mission, stored.error().message));
  }
  for (std::size_t i = 0; i < missions.size(); ++i) Keep(missions[i], std::move((*stored)[i]));
}

Result<mission::Mission> MissionRegistry::AsTaken(mission::Mission mission) {
  if (!mission::IsGroup(mission.agent.value())) return mission;
  const auto found = store_->Find({.id = mission.id});
  if (!found) return tl::unexpected(found.error());
  for (const mission::Record& record : found->missions) {
    if (!mission::Means(mission.agent.value(), record.mission.agent.value())) continue;
    mission.agent = record.mission.agent;
    break;
  }
  return mission;
}

// The command is repeated, and what it meant has changed by then.
void MissionRegistry::AnswerForGroup(const exchange::NowCommand& command) {
  using exchange::NowOrder;
  const AgentId group(command.name);
  auto& answer = answers_.Touch({group, {command.client, command.number}});
  const bool is_for_groups = command.order == NowOrder::kCancel ||
                             command.order == NowOrder::kStop || command.order == NowOrder::kResume;
  const bool waits = unanswered_.contains(group);
  if (!answer) {
    answer = exchange::NowAnswer{.agent = group,
                                 .client = command.client,
                                 .number = command.number,
                                 .refused = !waits || !is_for_groups,
                                 .detail = !is_for_groups ? "a group is told to cancel, stop or "
                                                            "resume alone; tell its robots"
                                           : waits        ? "what waits for the group is told so"
                                                          : "no mission waits for the group",
                                 .relayed = true};
  }
  outgoing_.emplace_back(*answer);
}

std::vector<AgentId> MissionRegistry::HeardOf(const AgentId& group) const {
  std::vector<AgentId> robots;
  for (const auto& [agent, heard] : heard_) {
    if (mission::Means(group.value(), agent.value())) robots.push_back(agent);
  }
  std::sort(robots.begin(), robots.end());
  return robots;
}

bool MissionRegistry::IsHeard(const AgentId& agent) const {
  if (mission::IsGroup(agent.value())) return !HeardOf(agent).empty();
  return heard_.Find(agent) != nullptr;
}

std::string MissionRegistry::WhyNotFree(const AgentId& robot, const mission::Record& record) const {
  const Heard& heard = *heard_.Find(robot);
  if (heard.hold != exchange::AgentHold::kNone) return heard.hold_text;
  if (const std::string held = HeldBy(robot); !held.empty()) return held;
  if (IsAtWork(robot)) return AtWorkText(robot);
  if (const auto queue = unanswered_.find(robot); queue != unanswered_.end()) {
    return fmt::format("mission {} waits for it", queue->second.front().mission.id);
  }
  if (const auto known = store_->Get(robot, record.mission.id); !known || *known) {
    return known ? "it has that mission already" : known.error().message;
  }
  if (check_first_) {
    mission::Record as_its_own = record;
    as_its_own.mission.agent = robot;
    if (std::string why = check_first_(as_its_own); !why.empty()) return why;
  }
  const auto going = mission::GoingIn(record.mission.orders);
  if (!going || !check_way_) return "";
  const auto way = check_way_(robot, going->to);
  return way ? "" : way.error().message;
}

std::string MissionRegistry::WhyNobodyIsFree(const AgentId& group) const {
  if (const std::string held = HeldBy(group); !held.empty()) return held;
  const auto queue = unanswered_.find(group);
  const std::vector<AgentId> robots = HeardOf(group);
  if (queue == unanswered_.end()) return "";
  if (robots.empty()) return fmt::format("no robot of {} is heard", group.value());
  std::vector<std::string> reasons;
  for (const AgentId& robot : robots) {
    const std::string why = WhyNotFree(robot, queue->second.front());
    if (why.empty()) return "";
    reasons.push_back(fmt::format("{}: {}", robot.value(), why));
  }
  return fmt::format("no robot of {} is free; {}", group.value(), fmt::join(reasons, "; "));
}

void MissionRegistry::GiveToGroups() {
  std::vector<AgentId> groups;
  for (const auto& [agent, queue] : unanswered_) {
    if (mission::IsGroup(agent.value())) groups.push_back(agent);
  }
  for (const AgentId& group : groups) {
    changed_.insert(group);
    if (!HeldBy(group).empty()) continue;
    Queue& queue = unanswered_.at(group);
    for (const AgentId& robot : HeardOf(group)) {
      if (queue.empty() || !WhyNotFree(robot, queue.front()).empty()) continue;
      Waiting given = queue.front();
      const auto assigned = store_->Assign(group, given.mission.id, robot);
      NoteStored(assigned);
      if (!assigned) {
        Warn(assigned.error());
        continue;
      }
      queue.pop_front();
      given.mission.agent = given.last.agent = robot;
      given.told = {};
      given.is_asked = true;
      given.expires.reset();
      notes_.push_back(
          {fmt::format("'{}' takes {} of {}", robot.value(), given.mission.id, group.value())});
      unanswered_[robot].push_back(std::move(given));
      changed_.insert(robot);
      heard_.Find(robot)->tell_at = {};
    }
    if (queue.empty()) unanswered_.erase(group);
  }
}

}  // namespace trailcast::server
