#include "route_server/fleet/mission_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "services/base/process_name.h"
#include "services/base/text.h"
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

// Another path to the same place is the same mission.
bool AreSame(const std::string& orders, const std::string& others) {
  if (orders == others) return true;
  const auto going = mission::GoingIn(orders);
  const auto other = mission::GoingIn(others);
  return going && other && going->to == other->to && (going->way > 1 || other->way > 1);
}

// Returns the states after which a robot will report others.
std::uint32_t UnendedStates() {
  std::uint32_t states = 0;
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    const auto state = static_cast<mission::State>(i);
    if (state != mission::State::kSent && !mission::HasEnded(state)) states |= 1U << i;
  }
  return states;
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

bool IsMeant(const exchange::NowCommand& command, const mission::Mission& mission) {
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
  return board;
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
    if (!command->relayed) On(*command, now_unix_ms);
  } else if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) {
    if (!answer->relayed) On(*answer);
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
  Say(stored.last);
  std::deque<Waiting>& pending = unanswered_[mission.agent];
  const bool is_known = std::any_of(pending.begin(), pending.end(), [&](const auto& record) {
    return record.mission.id == mission.id;
  });
  if (!is_known && stored.last.state == mission::State::kSent) {
    notes_.push_back({fmt::format("'{}' sends {}", mission.client.value(), Describe(mission))});
    pending.emplace_back(std::move(stored));
    if (Heard* heard = heard_.Find(mission.agent)) heard->tell_at = {};
  }
  if (pending.empty()) unanswered_.erase(mission.agent);
}

// Handles a robot's report, which is on the disk before the server repeats it.
void MissionBoard::On(const mission::Report& report, std::int64_t now_unix_ms) {
  const auto are_news = store_->Change({&report, 1}, now_unix_ms);
  NoteStored(are_news);
  if (!are_news) {
    Warn(are_news.error());
    return;
  }
  Say(report);
  const auto pending = unanswered_.find(report.agent);
  if (pending != unanswered_.end()) {
    std::erase_if(pending->second, [&](const mission::Record& record) {
      return record.mission.id == report.mission;
    });
    if (pending->second.empty()) unanswered_.erase(pending);
  }
  if (!are_news->front()) return;
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

// A stop voids the missions that were sent before, even if the robot has not heard of them yet.
void MissionBoard::On(const exchange::NowCommand& command, std::int64_t now_unix_ms) {
  if (std::exchange(commands_.Touch({command.client, command.number}), true)) return;
  if (const auto added = store_->Add(command, now_unix_ms); !added) Warn(added.error());
  const bool voids =
      command.order == exchange::NowOrder::kCancel || command.order == exchange::NowOrder::kStop;
  if (!voids) return;
  const std::string why =
      fmt::format("{} told it to {} before it had this mission",
                  WithoutProcess(command.client.value()), exchange::ToString(command.order));
  Drop(
      mission::State::kCancelled,
      [&](const Waiting& record) {
        return IsMeant(command, record.mission) ? std::optional(why) : std::nullopt;
      },
      now_unix_ms);
}

void MissionBoard::On(const exchange::NowAnswer& answer) {
  const NowKey command{answer.client, answer.number};
  if (std::exchange(answers_.Touch({answer.agent, command}), true)) return;
  if (const auto added = store_->Add(answer); !added) Warn(added.error());
}

void MissionBoard::Drop(mission::State state, const Why& why, std::int64_t now_unix_ms) {
  std::vector<mission::Report> reports;
  for (const auto& [agent, missions] : unanswered_) {
    for (const Waiting& record : missions) {
      if (const auto reason = why(record)) {
        reports.push_back(OwnReport(record.mission, state, *reason));
      }
    }
  }
  if (reports.empty()) return;
  const auto stored = store_->Change(reports, now_unix_ms);
  NoteStored(stored);
  if (!stored) {
    Warn(stored.error());
    return;
  }
  for (auto& [agent, missions] : unanswered_) {
    std::erase_if(missions, [&](const Waiting& record) {
      const auto reason = why(record);
      if (reason) {
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
    heard_.Erase(status.agent);
    return;
  }
  met_.Touch(status.agent);
  Heard& heard = heard_.Touch(status.agent);
  if (heard.instance == status.instance) return;
  heard = {.instance = status.instance,
           .tell_at = now,
           .pause = kSoon,
           .agree_at = now,
           .agree_pause = kSoon};
}

void MissionBoard::On(const exchange::AgentGone& gone) {
  const Heard* heard = heard_.Find(gone.agent);
  if (heard != nullptr && heard->instance == gone.instance) heard_.Erase(gone.agent);
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

void MissionBoard::Expire(Time now, std::int64_t now_unix_ms) {
  for (auto& [agent, missions] : unanswered_) {
    for (Waiting& record : missions) {
      if (record.expires) continue;
      const milliseconds valid = std::chrono::seconds(ValidFor_s(record.mission));
      const milliseconds waited(now_unix_ms - record.sent_unix_ms);
      record.expires = now + valid - std::clamp(waited, milliseconds(0), valid);
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

std::vector<exchange::Message> MissionBoard::Tick(Time now, std::int64_t now_unix_ms) {
  if (now >= expire_at_) {
    expire_at_ = now + kExpireEvery;
    Expire(now, now_unix_ms);
  }
  Agree(now);
  for (const auto& [agent, missions] : unanswered_) {
    Heard* heard = heard_.Find(agent);
    if (heard == nullptr || now < heard->tell_at) continue;
    heard->tell_at = now + heard->pause;
    heard->pause = std::min(2 * heard->pause, kLate);
    mission::Mission copy = missions.front().mission;
    copy.relayed = true;
    outgoing_.emplace_back(std::move(copy));
  }
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
