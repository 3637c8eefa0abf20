#include "route_server/fleet/mission_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "route_server/fleet/kept_mission.h"
#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/mission/address.h"
#include "services/mission/orders.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kExpireEvery{1000};
// A new path is repeated this often, because robots do not answer it.
constexpr milliseconds kAmendedEvery{2000};
// Strangers can make up missions that are under way on a robot.
constexpr std::size_t kMostUnended = 64;

std::uint32_t WayOf(const mission::Mission& mission) {
  const auto going = mission::GoingIn(mission.orders);
  return going ? going->way : 0;
}

// Another path to the same place is the same mission.
bool AreSame(const std::string& orders, const std::string& others) {
  if (orders == others) return true;
  const auto going = mission::GoingIn(orders);
  const auto other = mission::GoingIn(others);
  if (!going || !other || going->to != other->to) return false;
  const std::string without = OrdersWithoutWay(*going);
  return going->way > 1 || other->way > 1 || orders == without || others == without;
}

// Returns the states after which a robot will report others.
std::uint32_t UnendedStates() {
  const std::uint32_t all = (1U << mission::kStates) - 1;
  return all & ~EndedStates() & ~(1U << static_cast<unsigned>(mission::State::kSent));
}

// A robot that is held says why, if not in its first word of it.
std::string HoldText(const exchange::AgentStatus& status) {
  if (status.hold == exchange::AgentHold::kNone) return "";
  if (!status.detail.empty()) return status.detail;
  return status.hold == exchange::AgentHold::kPaused ? "it is paused" : "it is stopped";
}

}  // namespace

mission::Report PutOff(const mission::Mission& mission, const std::string& why) {
  return OwnReport(mission, mission::State::kPutOff, why);
}

Result<std::unique_ptr<MissionRegistry>> MissionRegistry::Open(
    AgentId server, std::unique_ptr<store::MissionStore> store) {
  std::unique_ptr<MissionRegistry> registry(
      new MissionRegistry(std::move(server), std::move(store)));
  auto unanswered = registry->store_->Unanswered();
  if (!unanswered) return tl::unexpected(unanswered.error());
  for (mission::Record& record : *unanswered) {
    registry->unanswered_[record.mission.agent].emplace_back(std::move(record));
  }
  if (auto loaded = registry->LoadCurrent(); !loaded) return tl::unexpected(loaded.error());
  if (auto loaded = registry->LoadQueues(); !loaded) return tl::unexpected(loaded.error());
  return registry;
}

Result<void> MissionRegistry::LoadCurrent() {
  mission::Query query{.states = UnendedStates()};
  while (current_.size() < kMostAgents) {
    auto page = store_->Find(query);
    if (!page) return tl::unexpected(page.error());
    for (mission::Record& record : page->missions) {
      unended_.Touch(record.mission.agent)[record.mission.id] = record.last;
      if (current_.Find(record.mission.agent) != nullptr) continue;
      current_.Touch(record.mission.agent).record = std::move(record);
    }
    if (page->next == 0) break;
    query.before = page->next;
  }
  return {};
}

std::size_t MissionRegistry::unanswered() const {
  std::size_t count = 0;
  for (const auto& [agent, missions] : unanswered_) count += missions.size();
  return count;
}

void MissionRegistry::Handle(const exchange::Message& message, Time now, std::int64_t now_unix_ms) {
  if (const auto* mission = std::get_if<mission::Mission>(&message)) {
    if (!mission->relayed) Take({mission, 1}, now, now_unix_ms);
  } else if (const auto* report = std::get_if<mission::Report>(&message)) {
    if (!report->relayed) On(*report, now_unix_ms);
  } else if (const auto* request = std::get_if<exchange::MissionRequest>(&message)) {
    On(*request);
  } else if (const auto* command = std::get_if<exchange::NowCommand>(&message)) {
    if (!command->relayed) On(*command, now, now_unix_ms);
  } else if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) {
    if (!answer->relayed) On(*answer, now, now_unix_ms);
  } else if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    On(*status, now);
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    On(*gone);
  }
}

void MissionRegistry::Say(mission::Report report) {
  report.relayed = true;
  outgoing_.emplace_back(std::move(report));
}

bool MissionRegistry::Refuses(const mission::Mission& mission) {
  const auto tasks = mission::ParseOrders(mission.orders);
  if (!tasks) Say(OwnReport(mission, mission::State::kRefused, tasks.error().message));
  return !tasks;
}

void MissionRegistry::Take(std::span<const mission::Mission> missions, Time now,
                           std::int64_t now_unix_ms) {
  std::vector<mission::Mission> readable;
  for (const mission::Mission& mission : missions) {
    if (Refuses(mission)) continue;
    const auto addressed = mission::ParseAddress(mission.agent.value());
    if (addressed && addressed->size() > 1) {
      TakeForAll(mission, *addressed, now, now_unix_ms);
    } else if (auto taken = AsTaken(mission)) {
      readable.push_back(*std::move(taken));
    } else {
      Say(PutOff(mission, taken.error().message));
    }
  }
  if (readable.empty()) return;
  std::vector<Result<mission::Record>> stored = store_->Add(readable, now_unix_ms);
  for (std::size_t i = 0; i < readable.size(); ++i) {
    if (stored[i]) {
      Keep(readable[i], *std::move(stored[i]));
      continue;
    }
    const Error& error = stored[i].error();
    if (told_.IsDue(error.message, now)) Warn(error);
    Say(PutOff(readable[i], error.message));
  }
}

void MissionRegistry::Keep(const mission::Mission& mission, mission::Record stored) {
  if (!AreSame(stored.mission.orders, mission.orders)) {
    Say(OwnReport(mission, mission::State::kRefused,
                  fmt::format("the robot's mission {} is another one: {}", mission.id,
                              stored.mission.orders)));
    return;
  }
  if (stored.last.state != mission::State::kSent) {
    Say(stored.last);
    return;
  }
  Queue& queue = unanswered_[mission.agent];
  auto known = std::find_if(queue.begin(), queue.end(),
                            [&](const auto& record) { return record.mission.id == mission.id; });
  if (known == queue.end()) {
    notes_.push_back({fmt::format("'{}' sends {}", mission.client.value(), Describe(mission))});
    known = queue.insert(known, Waiting(std::move(stored)));
    if (Heard* heard = heard_.Find(mission.agent)) heard->tell_at = {};
    give_at_ = {};
  }
  known->is_asked = true;
  changed_.insert(mission.agent);
}

// Handles a robot's report, which is on the disk before the server repeats it.
void MissionRegistry::On(const mission::Report& report, std::int64_t now_unix_ms) {
  HoldAfter(report, now_unix_ms);
  const auto are_news = store_->Change({&report, 1}, now_unix_ms);
  NoteStored(are_news);
  if (!are_news) {
    Warn(are_news.error());
    return;
  }
  Say(report);
  changed_.insert(report.agent);
  const auto pending = unanswered_.find(report.agent);
  if (pending != unanswered_.end()) {
    std::erase_if(pending->second, [&](const mission::Record& record) {
      return record.mission.id == report.mission;
    });
    if (pending->second.empty()) unanswered_.erase(pending);
  }
  if (!are_news->front()) return NoteOther(report);
  if (Heard* heard = heard_.Find(report.agent)) {
    heard->tell_at = {};
    heard->pause = kSoon;
  }
  NoteCurrent(report);
  if (mission::HasEnded(report.state)) {
    NoteEnded(report.agent, report.mission);
    give_at_ = {};
  }
  notes_.push_back({fmt::format("mission {} of '{}': {}{}{}", report.mission, report.agent.value(),
                                mission::ToString(report.state), report.detail.empty() ? "" : ": ",
                                PlainText(report.detail, 200))});
}

void MissionRegistry::NoteCurrent(const mission::Report& report) {
  if (!mission::HasEnded(report.state)) {
    unended_.Touch(report.agent)[report.mission] = report;
  } else if (auto* unended = unended_.Find(report.agent)) {
    unended->erase(report.mission);
    if (unended->empty()) unended_.Erase(report.agent);
  }
  Current* known = current_.Find(report.agent);
  const bool is_known = known != nullptr && known->record.mission.id == report.mission;
  if (mission::HasEnded(report.state)) {
    if (is_known) current_.Erase(report.agent);
    return;
  }
  if (is_known) {
    known->record.last = report;
    return;
  }
  auto found = store_->Find({.agent = report.agent.value(), .id = report.mission});
  if (!found) return Warn(found.error());
  if (found->missions.empty()) return;
  current_.Touch(report.agent) = {.record = std::move(found->missions.front())};
}

void MissionRegistry::NoteOther(const mission::Report& report) {
  auto* unended = unended_.Find(report.agent);
  const bool has_ended = mission::HasEnded(report.state);
  const bool is_noted = unended != nullptr && unended->contains(report.mission);
  if (has_ended != is_noted) return;
  const auto stored = store_->Find({.agent = report.agent.value(), .id = report.mission});
  if (!stored || !stored->missions.empty()) return;
  if (!has_ended) {
    if (unended == nullptr) unended = &unended_.Touch(report.agent);
    if (unended->size() < kMostUnended) (*unended)[report.mission] = report;
    return;
  }
  unended->erase(report.mission);
  if (unended->empty()) unended_.Erase(report.agent);
  if (Heard* heard = heard_.Find(report.agent)) heard->tell_at = {};
}

void MissionRegistry::NoteEnded(const AgentId& agent, const std::string& id) {
  auto stored = store_->Get(agent, id);
  if (!stored) return Warn(stored.error());
  if (*stored) ended_.Touch(agent) = **std::move(stored);
}

// Missions end in another order than that in which they were sent, but not long after others.
const mission::Record* MissionRegistry::LastEnded(const AgentId& agent) {
  constexpr std::uint32_t kLookedThrough = 64;
  if (const auto* known = ended_.Find(agent)) return *known ? &**known : nullptr;
  auto& last = ended_.Touch(agent);
  auto found =
      store_->Find({.agent = agent.value(), .states = EndedStates(), .page_size = kLookedThrough});
  if (!found) {
    Warn(found.error());
    return nullptr;
  }
  for (mission::Record& record : found->missions) {
    if (record.last.change == 0 && !EndsHere(record, record.last.state)) continue;
    if (!last || last->changed_unix_ms < record.changed_unix_ms) last = std::move(record);
  }
  return last ? &*last : nullptr;
}

std::vector<const mission::Record*> MissionRegistry::QueueOf(const AgentId& agent) const {
  std::vector<const mission::Record*> waiting;
  const auto queue = unanswered_.find(agent);
  if (queue == unanswered_.end()) return waiting;
  for (const Waiting& each : queue->second) waiting.push_back(&each);
  return waiting;
}

bool MissionRegistry::IsHanded(const AgentId& agent) const {
  const auto queue = unanswered_.find(agent);
  return queue != unanswered_.end() && queue->second.front().is_handed;
}

std::vector<const mission::Record*> MissionRegistry::HandedOver() const {
  std::vector<const mission::Record*> handed;
  for (const auto& [agent, current] : current_) handed.push_back(&current.record);
  for (const auto& [agent, queue] : unanswered_) {
    if (queue.front().is_handed) handed.push_back(&queue.front());
  }
  return handed;
}

const mission::Record* MissionRegistry::CurrentOf(const AgentId& agent) const {
  const Current* current = current_.Find(agent);
  return current == nullptr ? nullptr : &current->record;
}

std::vector<AgentId> MissionRegistry::AtWork() const {
  std::vector<AgentId> agents;
  for (const auto& [agent, current] : current_) agents.push_back(agent);
  return agents;
}

Result<void> MissionRegistry::Amend(const AgentId& agent, const std::string& orders) {
  Current* current = current_.Find(agent);
  if (current == nullptr) return Fail(ErrorCode::kNotFound, "'{}' has no mission", agent.value());
  mission::Mission& mission = current->record.mission;
  const auto stored = store_->Amend(agent, mission.id, orders);
  NoteStored(stored);
  if (!stored) return tl::unexpected(stored.error());
  mission.orders = orders;
  current->record.last.task = 0;  // of the new path
  current->tell_at = {};
  notes_.push_back({Describe(mission)});
  return {};
}

Result<void> MissionRegistry::LookUp(const exchange::MissionRequest& request,
                                     exchange::MissionReply& reply) {
  if (request.commands) {
    auto page = store_->FindCommands(request.query);
    if (!page) return tl::unexpected(page.error());
    reply.commands = std::move(page->commands);
    reply.next = page->next;
    return {};
  }
  auto page = store_->Find(request.query);
  if (!page) return tl::unexpected(page.error());
  reply.missions = std::move(page->missions);
  reply.next = page->next;
  if (!request.query.agent.empty()) reply.robots = RobotsLike(request.query.agent);
  for (mission::Record& record : reply.missions) {
    const auto queue = unanswered_.find(record.mission.agent);
    if (record.last.state != mission::State::kSent || queue == unanswered_.end()) continue;
    for (const Waiting& waiting : queue->second) {
      const bool is_this = waiting.mission.id == record.mission.id;
      if (is_this && !waiting.told.mission.empty()) record.last = waiting.told;
    }
  }
  return {};
}

// Returns the robot itself if it was heard; else who asks can say which may have been meant.
std::vector<std::string> MissionRegistry::RobotsLike(const std::string& robot) const {
  if (met_.Find(AgentId(robot)) != nullptr) return {robot};
  std::vector<std::string> robots;
  for (const auto& [agent, met] : met_) {
    if (mission::IsGroup(robot) && mission::Means(robot, agent.value())) return {agent.value()};
  }
  for (const auto& [agent, met] : met_) {
    if (robots.size() == exchange::kMaxRobotsTold) break;
    robots.push_back(agent.value());
  }
  return robots;
}

void MissionRegistry::On(const exchange::MissionRequest& request) {
  exchange::MissionReply reply{
      .server = server_, .client = request.client, .request = request.request};
  if (const auto looked_up = LookUp(request, reply); !looked_up) {
    reply.error = PlainText(looked_up.error().message, exchange::kMaxLineBytes);
  }
  outgoing_.emplace_back(std::move(reply));
}

void MissionRegistry::On(const exchange::AgentStatus& status, Time now) {
  const bool is_there =
      status.role == exchange::AgentRole::kFollower && status.mode != exchange::AgentMode::kStopped;
  if (!is_there) {
    if (heard_.Find(status.agent) != nullptr) changed_.insert(status.agent);
    heard_.Erase(status.agent);
    return;
  }
  met_.Touch(status.agent);
  Heard& heard = heard_.Touch(status.agent);
  const bool is_new = heard.instance != status.instance;
  if (is_new) {
    heard = {.instance = status.instance,
             .tell_at = now,
             .pause = kSoon,
             .agree_at = now,
             .agree_pause = kSoon};
  }
  const std::string hold_text = HoldText(status);
  if (is_new || heard.hold != status.hold || heard.hold_text != hold_text) {
    heard.hold = status.hold;
    heard.hold_text = hold_text;
    heard.tell_at = now;
    changed_.insert(status.agent);
  }
}

void MissionRegistry::On(const exchange::AgentGone& gone) {
  const Heard* heard = heard_.Find(gone.agent);
  if (heard == nullptr || heard->instance != gone.instance) return;
  heard_.Erase(gone.agent);
  changed_.insert(gone.agent);
}

void MissionRegistry::Agree(Time now) {
  for (auto& [agent, heard] : heard_) {
    const auto* unended = now < heard.agree_at ? nullptr : unended_.Find(agent);
    if (unended == nullptr) continue;
    heard.agree_at = now + heard.agree_pause;
    heard.agree_pause = std::min(2 * heard.agree_pause, kLate);
    for (const auto& [id, report] : *unended) Say(report);
  }
}

std::vector<exchange::Message> MissionRegistry::Tick(Time now, std::int64_t now_unix_ms) {
  if (now >= expire_at_) {
    expire_at_ = now + kExpireEvery;
    Expire(now, now_unix_ms);
  }
  Agree(now);
  if (now >= give_at_) {
    give_at_ = now + kSoon;
    GiveToGroups();
  }
  HandOver(now, now_unix_ms);
  TellQueues();
  for (auto& [agent, current] : current_) {
    if (now < current.tell_at || heard_.Find(agent) == nullptr) continue;
    current.tell_at = now + kAmendedEvery;
    if (WayOf(current.record.mission) < 2) continue;
    mission::Mission copy = current.record.mission;
    copy.relayed = true;
    outgoing_.emplace_back(std::move(copy));
  }
  return std::exchange(outgoing_, {});
}

}  // namespace trailcast::server
