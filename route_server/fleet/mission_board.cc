#include "route_server/fleet/mission_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <variant>

#include "services/base/process_name.h"
#include "services/base/text.h"
#include "services/base/unix_time.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;

// A robot that has not answered is told again after the first pause, and later after ever longer
// ones up to the second.
constexpr milliseconds kSoon{1000};
constexpr milliseconds kLate{30'000};
constexpr milliseconds kExpireEvery{1000};
// A new path is repeated this often, because robots do not answer it.
constexpr milliseconds kAmendedEvery{2000};
// Strangers can make up missions that are under way on a robot.
constexpr std::size_t kMostUnended = 64;
// The mission of a robot that is sent home.
constexpr const char* kHomePrefix = "home-";
constexpr const char* kHome = "home";
constexpr std::uint32_t kHomeWithin_s = 600;

std::string Describe(const mission::Mission& mission) {
  return fmt::format("mission {} of '{}': {}", mission.id, mission.agent.value(),
                     PlainText(mission.orders, 200));
}

std::uint32_t WayOf(const mission::Mission& mission) {
  const auto going = mission::GoingIn(mission.orders);
  return going ? going->way : 0;
}

std::uint32_t ValidFor_s(const mission::Mission& mission) {
  const std::uint32_t asked_s = mission.valid_for_s;
  return asked_s == 0 ? mission::kLongestValid_s : std::min(asked_s, mission::kLongestValid_s);
}

// Returns the orders of a mission whose path is only found once its robot is about to begin.
std::string OrdersWithoutWay(const std::string& goal) {
  return fmt::format("goto {} wait way", goal);
}

bool SendsHome(const mission::Record& record) {
  return record.mission.id.starts_with(kHomePrefix) &&
         record.mission.orders == OrdersWithoutWay(kHome);
}

// Another path to the same place is the same mission.
bool AreSame(const std::string& orders, const std::string& others) {
  if (orders == others) return true;
  const auto going = mission::GoingIn(orders);
  const auto other = mission::GoingIn(others);
  if (!going || !other || going->to != other->to) return false;
  const std::string without = OrdersWithoutWay(going->to);
  return going->way > 1 || other->way > 1 || orders == without || others == without;
}

std::uint32_t EndedStates() {
  std::uint32_t states = 0;
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    if (mission::HasEnded(static_cast<mission::State>(i))) states |= 1U << i;
  }
  return states;
}

// Returns the states after which a robot will report others.
std::uint32_t UnendedStates() {
  const std::uint32_t all = (1U << mission::kStates) - 1;
  return all & ~EndedStates() & ~(1U << static_cast<unsigned>(mission::State::kSent));
}

// Makes a report by the server itself.
mission::Report OwnReport(const mission::Mission& mission, mission::State state,
                          const std::string& why) {
  return {.agent = mission.agent,
          .mission = mission.id,
          .state = state,
          .detail = PlainText(why, exchange::kMaxLineBytes),
          .relayed = true};
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

mission::Report PutOff(const mission::Mission& mission, const std::string& why) {
  return OwnReport(mission, mission::State::kPutOff, why);
}

Result<std::unique_ptr<MissionBoard>> MissionBoard::Open(
    AgentId server, std::unique_ptr<store::MissionStore> store) {
  std::unique_ptr<MissionBoard> board(new MissionBoard(std::move(server), std::move(store)));
  auto unanswered = board->store_->Unanswered();
  if (!unanswered) return tl::unexpected(unanswered.error());
  for (mission::Record& record : *unanswered) {
    board->unanswered_[record.mission.agent].emplace_back(std::move(record));
  }
  if (auto loaded = board->LoadCurrent(); !loaded) return tl::unexpected(loaded.error());
  if (auto loaded = board->LoadQueues(); !loaded) return tl::unexpected(loaded.error());
  return board;
}

// Only the first mission of a robot that has none has been waiting for that robot, at most since
// the one before has ended and the queue was let go.
Result<void> MissionBoard::LoadQueues() {
  auto holds = store_->Holds();
  if (!holds) return tl::unexpected(holds.error());
  std::map<AgentId, std::int64_t> let_go_unix_ms;
  for (const store::MissionStore::Hold& hold : *holds) {
    changed_.insert(hold.agent);
    holds_.emplace(hold.agent, hold.why);
    let_go_unix_ms.emplace(hold.agent, hold.unix_ms);
  }
  constexpr auto kNotYet = std::numeric_limits<std::int64_t>::max();
  for (auto& [agent, queue] : unanswered_) {
    changed_.insert(agent);
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

Result<void> MissionBoard::LoadCurrent() {
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

std::size_t MissionBoard::unanswered() const {
  std::size_t count = 0;
  for (const auto& [agent, missions] : unanswered_) count += missions.size();
  return count;
}

void MissionBoard::Handle(const exchange::Message& message, Time now, std::int64_t now_unix_ms) {
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

void MissionBoard::Say(mission::Report report) {
  report.relayed = true;
  outgoing_.emplace_back(std::move(report));
}

bool MissionBoard::Refuses(const mission::Mission& mission) {
  const auto tasks = mission::ParseOrders(mission.orders);
  if (!tasks) Say(OwnReport(mission, mission::State::kRefused, tasks.error().message));
  return !tasks;
}

void MissionBoard::Take(std::span<const mission::Mission> missions, Time now,
                        std::int64_t now_unix_ms) {
  std::vector<mission::Mission> readable;
  for (const mission::Mission& mission : missions) {
    if (!Refuses(mission)) readable.push_back(mission);
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

void MissionBoard::Keep(const mission::Mission& mission, mission::Record stored) {
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
  }
  known->is_asked = true;
  changed_.insert(mission.agent);
}

// Handles a robot's report, which is on the disk before the server repeats it.
void MissionBoard::On(const mission::Report& report, std::int64_t now_unix_ms) {
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
  notes_.push_back({fmt::format("mission {} of '{}': {}{}{}", report.mission, report.agent.value(),
                                mission::ToString(report.state), report.detail.empty() ? "" : ": ",
                                PlainText(report.detail, 200))});
}

void MissionBoard::NoteCurrent(const mission::Report& report) {
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

void MissionBoard::NoteOther(const mission::Report& report) {
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

const mission::Record* MissionBoard::CurrentOf(const AgentId& agent) const {
  const Current* current = current_.Find(agent);
  return current == nullptr ? nullptr : &current->record;
}

std::vector<AgentId> MissionBoard::AtWork() const {
  std::vector<AgentId> agents;
  for (const auto& [agent, current] : current_) agents.push_back(agent);
  return agents;
}

Result<void> MissionBoard::Amend(const AgentId& agent, const std::string& orders) {
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

Result<void> MissionBoard::LookUp(const exchange::MissionRequest& request,
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
std::vector<std::string> MissionBoard::RobotsLike(const std::string& robot) const {
  if (met_.Find(AgentId(robot)) != nullptr) return {robot};
  std::vector<std::string> robots;
  for (const auto& [agent, met] : met_) {
    if (robots.size() == exchange::kMaxRobotsTold) break;
    robots.push_back(agent.value());
  }
  return robots;
}

void MissionBoard::On(const exchange::MissionRequest& request) {
  exchange::MissionReply reply{
      .server = server_, .client = request.client, .request = request.request};
  if (const auto looked_up = LookUp(request, reply); !looked_up) {
    reply.error = PlainText(looked_up.error().message, exchange::kMaxLineBytes);
  }
  outgoing_.emplace_back(std::move(reply));
}

// A cancellation voids the missions that were sent before it, even if the robot has not heard of
// them yet.
void MissionBoard::On(const exchange::NowCommand& command, Time now, std::int64_t now_unix_ms) {
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

bool MissionBoard::IsMeant(const exchange::NowCommand& command, const AgentId& agent) const {
  if (command.whom == exchange::NowWhom::kRobot) return command.name == agent.value();
  const Current* current = current_.Find(agent);
  if (current != nullptr && MeansMission(command, current->record.mission)) return true;
  const auto queue = unanswered_.find(agent);
  return queue != unanswered_.end() &&
         std::any_of(queue->second.begin(), queue->second.end(),
                     [&](const Waiting& each) { return MeansMission(command, each.mission); });
}

void MissionBoard::HoldOrLetGo(const exchange::NowCommand& command, std::int64_t now_unix_ms) {
  const bool lets_go = command.order == exchange::NowOrder::kResume;
  if (!lets_go && command.order != exchange::NowOrder::kStop) return;
  for (const auto& [agent, queue] : unanswered_) {
    if (!IsMeant(command, agent)) continue;
    if (lets_go) {
      LetGo(agent, now_unix_ms);
    } else {
      Hold(agent,
           fmt::format("stopped by {} {}, until it is released and told to resume",
                       WithoutProcess(command.client.value()), MomentText(now_unix_ms)),
           now_unix_ms);
    }
  }
}

std::string MissionBoard::HeldBy(const AgentId& agent) const {
  const auto hold = holds_.find(agent);
  return hold == holds_.end() ? "" : hold->second;
}

void MissionBoard::Hold(const AgentId& agent, const std::string& why, std::int64_t now_unix_ms) {
  const auto stored = store_->Put(store::MissionStore::Hold{agent, why, now_unix_ms});
  NoteStored(stored);
  if (!stored) Warn(stored.error());
  holds_[agent] = why;
  changed_.insert(agent);
}

void MissionBoard::LetGo(const AgentId& agent, std::int64_t now_unix_ms) {
  if (HeldBy(agent).empty()) return;
  Hold(agent, "", now_unix_ms);
  if (Heard* heard = heard_.Find(agent)) heard->tell_at = {};
}

// The hold is on the disk before the end is. A robot repeats the end of a mission until it is
// stored, and a repeated end that is known must not hold what an operator has let go meanwhile.
void MissionBoard::HoldAfter(const mission::Report& end, std::int64_t now_unix_ms) {
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
  Hold(end.agent,
       fmt::format("mission {} did not arrive ({}): resume the robot to go on, or cancel",
                   end.mission, mission::ToString(end.state)),
       now_unix_ms);
}

std::string MissionBoard::WhyNotNow(const AgentId& agent) const {
  const Heard* heard = heard_.Find(agent);
  if (heard != nullptr && heard->hold == exchange::AgentHold::kStopped) return heard->hold_text;
  const auto queue = unanswered_.find(agent);
  const bool goes_home = queue != unanswered_.end() && SendsHome(queue->second.front());
  if (const std::string held = HeldBy(agent); !held.empty() && !goes_home) return held;
  if (const auto* unended = unended_.Find(agent)) {
    const mission::Record* current = CurrentOf(agent);
    return current == nullptr ? "it does mission " + unended->begin()->first
                              : fmt::format("it does mission {}: {}", current->mission.id,
                                            current->mission.orders);
  }
  if (heard == nullptr) return "it is not heard";
  return heard->hold == exchange::AgentHold::kPaused ? heard->hold_text : "";
}

mission::Report MissionBoard::Waits(const Waiting& record, const Waiting* before) const {
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
void MissionBoard::TellQueues() {
  for (const AgentId& agent : std::exchange(changed_, {})) {
    const auto queue = unanswered_.find(agent);
    if (queue == unanswered_.end()) {
      if (holds_.erase(agent) == 0) continue;
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
void MissionBoard::NoteWaited(Waiting& record) {
  const auto going = mission::GoingIn(record.mission.orders);
  if (!going || !check_way_) return;
  const std::string orders = OrdersWithoutWay(going->to);
  if (record.mission.orders == orders) return;
  const auto stored = store_->Amend(record.mission.agent, record.mission.id, orders);
  NoteStored(stored);
  if (stored) record.mission.orders = orders;
}

bool MissionBoard::PlanAnew(const Waiting& record, std::int64_t now_unix_ms) {
  const auto going = mission::GoingIn(record.mission.orders);
  if (!going || record.mission.orders != OrdersWithoutWay(going->to)) return true;
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

void MissionBoard::On(const exchange::NowAnswer& answer, Time now, std::int64_t now_unix_ms) {
  const NowKey key{answer.client, answer.number};
  if (std::exchange(answers_.Touch({answer.agent, key}), answer)) return;
  if (const auto added = store_->Add(answer); !added) Warn(added.error());
  const auto* command = commands_.Find(key);
  if (command == nullptr || !*command) return;
  SendHome(exchange::NowCommand(**command), answer.agent, now, now_unix_ms);
}

// An answer may come before its command does.
void MissionBoard::SendHome(const exchange::NowCommand& command, const AgentId& agent, Time now,
                            std::int64_t now_unix_ms) {
  const auto* answer = answers_.Find({agent, {command.client, command.number}});
  const bool obeys = answer != nullptr && *answer && !(*answer)->refused;
  if (command.order != exchange::NowOrder::kHome || !obeys) return;
  const mission::Mission mission{.agent = agent,
                                 .id = fmt::format("{}{:016x}", kHomePrefix, command.number),
                                 .client = command.client,
                                 .orders = OrdersWithoutWay(kHome),
                                 .valid_for_s = kHomeWithin_s};
  Take({&mission, 1}, now, now_unix_ms);
  const auto found = unanswered_.find(agent);
  if (found == unanswered_.end() || found->second.back().mission.id != mission.id) return;
  Queue& queue = found->second;
  std::rotate(queue.begin(), queue.end() - 1, queue.end());
  if (queue.size() < 2) return;
  Hold(agent,
       fmt::format("sent home by {} {}, until it is told to resume",
                   WithoutProcess(command.client.value()), MomentText(now_unix_ms)),
       now_unix_ms);
}

void MissionBoard::Drop(mission::State state, const Why& why, std::int64_t now_unix_ms) {
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
    if (others_follow) HoldAfter(of_robot.front(), now_unix_ms);
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
        notes_.push_back({fmt::format("{}: {}: {}", Describe(record.mission),
                                      mission::ToString(state), *reason)});
      }
      return reason.has_value();
    });
  }
  std::erase_if(unanswered_, [](const auto& waiting) { return waiting.second.empty(); });
  for (mission::Report& report : reports) outgoing_.emplace_back(std::move(report));
}

void MissionBoard::On(const exchange::AgentStatus& status, Time now) {
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
  if (is_new || heard.hold != status.hold) {
    heard.hold = status.hold;
    heard.hold_text = status.hold == exchange::AgentHold::kNone ? "" : status.detail;
    heard.tell_at = now;
    changed_.insert(status.agent);
  }
}

void MissionBoard::On(const exchange::AgentGone& gone) {
  const Heard* heard = heard_.Find(gone.agent);
  if (heard == nullptr || heard->instance != gone.instance) return;
  heard_.Erase(gone.agent);
  changed_.insert(gone.agent);
}

void MissionBoard::Agree(Time now) {
  for (auto& [agent, heard] : heard_) {
    const auto* unended = now < heard.agree_at ? nullptr : unended_.Find(agent);
    if (unended == nullptr) continue;
    heard.agree_at = now + heard.agree_pause;
    heard.agree_pause = std::min(2 * heard.agree_pause, kLate);
    for (const auto& [id, report] : *unended) Say(report);
  }
}

// Counts the time for which a robot could have taken a mission and was not heard, or did not
// answer. A robot that is out of reach with a mission is given as long as any.
void MissionBoard::Expire(Time now, std::int64_t now_unix_ms) {
  for (auto& [agent, queue] : unanswered_) {
    const bool is_heard = heard_.Find(agent) != nullptr;
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

void MissionBoard::HandOver(Time now, std::int64_t now_unix_ms) {
  std::vector<AgentId> due;
  for (const auto& [agent, queue] : unanswered_) {
    Heard* heard = heard_.Find(agent);
    if (heard == nullptr || now < heard->tell_at) continue;
    heard->tell_at = now + kSoon;
    if (WhyNotNow(agent).empty()) due.push_back(agent);
  }
  for (const AgentId& agent : due) {
    const Waiting& first = unanswered_.at(agent).front();
    if (!PlanAnew(first, now_unix_ms)) continue;
    Heard* heard = heard_.Find(agent);
    heard->tell_at = now + heard->pause;
    heard->pause = std::min(2 * heard->pause, kLate);
    mission::Mission copy = first.mission;
    copy.relayed = true;
    outgoing_.emplace_back(std::move(copy));
  }
}

std::vector<exchange::Message> MissionBoard::Tick(Time now, std::int64_t now_unix_ms) {
  if (now >= expire_at_) {
    expire_at_ = now + kExpireEvery;
    Expire(now, now_unix_ms);
  }
  Agree(now);
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
