// This part of MissionRegistry is the robots' queues: what waits, for what, and when it is handed
// over.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

#include "route_server/fleet/kept_mission.h"
#include "route_server/fleet/mission_registry.h"
#include "services/mission/address.h"
#include "services/mission/orders.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;

std::uint32_t ValidFor_s(const mission::Mission& mission) {
  const std::uint32_t asked_s = mission.valid_for_s;
  return asked_s == 0 ? mission::kLongestValid_s : std::min(asked_s, mission::kLongestValid_s);
}

}  // namespace

// Only the first mission of a robot that has none has been waiting for that robot, at most since
// the one before has ended and the queue was let go.
Result<void> MissionRegistry::LoadQueues() {
  auto holds = store_->Holds();
  if (!holds) return tl::unexpected(holds.error());
  std::map<AgentId, std::int64_t> let_go_unix_ms;
  for (const store::MissionStore::Hold& hold : *holds) {
    changed_.insert(hold.agent);
    holds_.emplace(hold.agent, hold);
    let_go_unix_ms.emplace(hold.agent, hold.unix_ms);
  }
  constexpr auto kNotYet = std::numeric_limits<std::int64_t>::max();
  for (auto& [agent, queue] : unanswered_) {
    changed_.insert(agent);
    std::stable_partition(queue.begin(), queue.end(), SendsToCharge);
    std::stable_partition(queue.begin(), queue.end(), SendsHome);
    for (Waiting& record : queue) record.since_unix_ms = kNotYet;
    if (unended_.Find(agent) != nullptr) continue;
    const auto before =
        store_->Find({.agent = agent.value(), .states = EndedStates(), .page_size = 1});
    if (!before) return tl::unexpected(before.error());
    std::int64_t& since_unix_ms = queue.front().since_unix_ms;
    since_unix_ms = std::max(queue.front().sent_unix_ms, let_go_unix_ms[agent]);
    if (before->missions.empty()) continue;
    since_unix_ms = std::max(since_unix_ms, before->missions.front().changed_unix_ms);
  }
  return {};
}

std::string MissionRegistry::WhyNotNow(const AgentId& agent) const {
  if (mission::IsGroup(agent.value())) return WhyNobodyIsFree(agent);
  const Heard* heard = heard_.Find(agent);
  if (heard != nullptr && heard->hold == exchange::AgentHold::kStopped) return heard->hold_text;
  const auto queue = unanswered_.find(agent);
  const bool goes_home = queue != unanswered_.end() && SendsHome(queue->second.front());
  if (const std::string held = HeldBy(agent); !held.empty() && !goes_home) return held;
  if (IsAtWork(agent)) return AtWorkText(agent);
  if (heard == nullptr) return "it is not heard";
  if (heard->hold == exchange::AgentHold::kPaused) return heard->hold_text;
  return check_first_ && queue != unanswered_.end() ? check_first_(queue->second.front()) : "";
}

std::string MissionRegistry::AtWorkText(const AgentId& agent) const {
  const mission::Record* current = CurrentOf(agent);
  return current == nullptr
             ? "it does mission " + unended_.Find(agent)->begin()->first
             : fmt::format("it does mission {}: {}", current->mission.id, current->mission.orders);
}

mission::Report MissionRegistry::Waits(const Waiting& record, const Waiting* before) const {
  const std::string why =
      before == nullptr
          ? WhyNotNow(record.mission.agent)
          : fmt::format("mission {} comes before: {}", before->mission.id, before->mission.orders);
  auto report =
      OwnReport(record.mission, mission::State::kSent, why.empty() ? "" : "waits: " + why);
  if (!why.empty()) report.waits_for = mission::WaitsFor::kTurn;
  return report;
}

// Tells of each mission in queues that have changed what it waits for, if that is news or its
// sender asks. Nobody is told unasked of those that were loaded.
void MissionRegistry::TellQueues() {
  for (const AgentId& agent : std::exchange(changed_, {})) {
    const auto queue = unanswered_.find(agent);
    if (queue == unanswered_.end()) {
      const auto hold = holds_.find(agent);
      if (hold == holds_.end() || hold->second.stays) continue;
      holds_.erase(hold);
      if (const auto forgotten = store_->ForgetHold(agent); !forgotten) Warn(forgotten.error());
      continue;
    }
    const bool at_work = unended_.Find(agent) != nullptr;
    const Waiting* before = nullptr;
    for (Waiting& record : queue->second) {
      if (at_work || before != nullptr) NoteWaited(record);
      mission::Report report = Waits(record, std::exchange(before, &record));
      const bool is_news = !record.told.mission.empty() && report != record.told;
      record.told = report;
      if (std::exchange(record.is_asked, false) || is_news) Say(std::move(report));
    }
  }
}

// A robot that does something else first will stand elsewhere than its sender thought.
void MissionRegistry::NoteWaited(Waiting& record) {
  const auto going = mission::GoingIn(record.mission.orders);
  if (!going || !check_way_) return;
  const std::string orders = OrdersWithoutWay(*going);
  if (record.mission.orders == orders) return;
  const auto stored = store_->Amend(record.mission.agent, record.mission.id, orders);
  NoteStored(stored);
  if (stored) record.mission.orders = orders;
}

Result<void> MissionRegistry::Direct(const mission::Record& waiting, const std::string& goal) {
  const AgentId agent = waiting.mission.agent;
  const std::string orders = OrdersWithoutWay({.to = goal});
  for (Waiting& each : unanswered_.at(agent)) {
    if (each.mission.id != waiting.mission.id || each.mission.orders == orders) continue;
    const auto stored = store_->Amend(agent, each.mission.id, orders);
    NoteStored(stored);
    if (!stored) return tl::unexpected(stored.error());
    each.mission.orders = orders;
    changed_.insert(agent);
  }
  return {};
}

void MissionRegistry::Withdraw(const mission::Record& waiting, const std::string& why,
                               std::int64_t now_unix_ms) {
  const mission::Mission mission = waiting.mission;
  Drop(
      mission::State::kExpired,
      [&](const Waiting& each) {
        const bool is_this = each.mission.agent == mission.agent && each.mission.id == mission.id;
        return is_this ? std::optional(why) : std::nullopt;
      },
      now_unix_ms, false);
}

bool MissionRegistry::PlanAnew(const Waiting& record, std::int64_t now_unix_ms) {
  const auto going = mission::GoingIn(record.mission.orders);
  if (!going || record.mission.orders != OrdersWithoutWay(*going)) return true;
  const Result<bool> found =
      check_way_ ? check_way_(record.mission.agent, going->to)
                 : Fail(ErrorCode::kUnavailable, "this server knows no network of routes");
  if (found && *found) return true;
  const AgentId agent = record.mission.agent;
  const std::string id = record.mission.id;
  const std::string why = found ? "it is there already" : found.error().message;
  Drop(
      found ? mission::State::kArrived : mission::State::kRefused,
      [&](const Waiting& each) {
        const bool is_this = each.mission.agent == agent && each.mission.id == id;
        return is_this ? std::optional(why) : std::nullopt;
      },
      now_unix_ms);
  return false;
}

void MissionRegistry::Drop(mission::State state, const Why& why, std::int64_t now_unix_ms,
                           bool holds) {
  std::vector<mission::Report> reports;
  for (const auto& [agent, queue] : unanswered_) {
    bool others_follow = false;
    std::vector<mission::Report> of_robot;
    for (const Waiting& record : queue) {
      if (const auto reason = why(record)) {
        of_robot.push_back(OwnReport(record.mission, state, *reason));
      } else {
        others_follow = others_follow || !of_robot.empty();
      }
    }
    if (holds && others_follow) HoldAfter(of_robot.front(), now_unix_ms);
    std::move(of_robot.begin(), of_robot.end(), std::back_inserter(reports));
  }
  if (reports.empty()) return;
  const auto stored = store_->Change(reports, now_unix_ms);
  NoteStored(stored);
  if (!stored) {
    Warn(stored.error());
    return;
  }
  for (auto& [agent, missions] : unanswered_) {
    std::erase_if(missions, [&, &agent = agent](const Waiting& record) {
      const auto reason = why(record);
      if (reason) {
        changed_.insert(agent);
        if (EndsHere(record, state)) NoteEnded(agent, record.mission.id);
        notes_.push_back({fmt::format("{}: {}: {}", Describe(record.mission),
                                      mission::ToString(state), *reason)});
      }
      return reason.has_value();
    });
  }
  std::erase_if(unanswered_, [](const auto& waiting) { return waiting.second.empty(); });
  for (mission::Report& report : reports) outgoing_.emplace_back(std::move(report));
}

// Counts the time for which a robot could have taken a mission and was not heard, or did not
// answer. A robot that is out of reach with a mission is given as long as any.
void MissionRegistry::Expire(Time now, std::int64_t now_unix_ms) {
  for (auto& [agent, queue] : unanswered_) {
    const bool is_heard = IsHeard(agent);
    const bool at_work = unended_.Find(agent) != nullptr;
    const bool first_waits = !WhyNotNow(agent).empty();
    for (Waiting& record : queue) {
      const bool waits = first_waits || &record != &queue.front();
      const milliseconds valid =
          std::chrono::seconds(at_work ? mission::kLongestValid_s : ValidFor_s(record.mission));
      if (is_heard && waits) {
        record.expires = now + valid;
      } else if (record.expires) {
        record.expires = std::min(*record.expires, now + valid);
      } else {
        const std::int64_t waited_ms =
            now_unix_ms > record.since_unix_ms ? now_unix_ms - record.since_unix_ms : 0;
        record.expires = now + valid - std::min(milliseconds(waited_ms), valid);
      }
    }
  }
  Drop(
      mission::State::kExpired,
      [&](const Waiting& record) -> std::optional<std::string> {
        if (now < *record.expires) return std::nullopt;
        return fmt::format("the robot did not answer within {} s", ValidFor_s(record.mission));
      },
      now_unix_ms);
}

void MissionRegistry::HandOver(Time now, std::int64_t now_unix_ms) {
  std::vector<AgentId> due;
  for (const auto& [agent, queue] : unanswered_) {
    Heard* heard = heard_.Find(agent);
    if (heard == nullptr || now < heard->tell_at) continue;
    heard->tell_at = now + kSoon;
    if (WhyNotNow(agent).empty()) due.push_back(agent);
  }
  for (const AgentId& agent : due) {
    Waiting& first = unanswered_.at(agent).front();
    // One that was handed over a moment ago may stand in its way.
    if (!WhyNotNow(agent).empty() || !PlanAnew(first, now_unix_ms)) continue;
    first.is_handed = true;
    Heard* heard = heard_.Find(agent);
    heard->tell_at = now + heard->pause;
    heard->pause = std::min(2 * heard->pause, kLate);
    mission::Mission copy = first.mission;
    copy.relayed = true;
    outgoing_.emplace_back(std::move(copy));
  }
}
}  // namespace trailcast::server
