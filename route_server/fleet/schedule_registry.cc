#include "route_server/fleet/schedule_registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "services/base/process_name.h"
#include "services/base/text.h"
#include "services/exchange/bounds.h"

namespace trailcast::server {
namespace {

using std::chrono::milliseconds;
using Kept = store::MissionStore::Schedule;
using Lines = std::vector<std::string>;

constexpr milliseconds kLookAtAllEvery{1000};
constexpr std::size_t kMostOutcomeBytes = 200;

const Kept::Sent* SentTo(const Kept& kept, const AgentId& agent) {
  const auto found = std::find_if(kept.sent.begin(), kept.sent.end(),
                                  [&](const Kept::Sent& sent) { return sent.agent == agent; });
  return found == kept.sent.end() ? nullptr : &*found;
}

Result<void> CheckThatItComes(const schedule::Schedule& schedule, std::int64_t now_unix_ms) {
  if (NextDue(schedule, now_unix_ms)) return {};
  return Fail(ErrorCode::kInvalidArgument, "schedule {}: {} is past, it is {} now", schedule.name,
              WhenText(schedule), schedule::TextIn(schedule.zone, now_unix_ms));
}

std::string Became(const mission::Report& report) {
  return fmt::format("{}{}{}", mission::ToString(report.state), report.detail.empty() ? "" : ": ",
                     report.detail);
}

}  // namespace

Result<std::unique_ptr<ScheduleRegistry>> ScheduleRegistry::Open(AgentId server,
                                                                 store::MissionStore& store,
                                                                 Site site) {
  std::unique_ptr<ScheduleRegistry> registry(
      new ScheduleRegistry(std::move(server), store, std::move(site)));
  auto all = store.Schedules();
  if (!all) return tl::unexpected(all.error());
  for (Kept& kept : *all) {
    auto schedule = schedule::ParseSchedule(kept.words);
    if (!schedule) {
      registry->notes_.push_back(
          fmt::format("schedule {} sends nothing: {}", kept.name, schedule.error().message));
      continue;
    }
    Entry& entry = registry->entries_[kept.name];
    entry.schedule = *std::move(schedule);
    entry.next_unix_ms = NextDue(entry.schedule, kept.looked_unix_ms);
    entry.kept = std::move(kept);
  }
  return registry;
}

void ScheduleRegistry::Hear(const exchange::Message& message) {
  if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) heard_.Erase(gone->agent);
  const auto* status = std::get_if<exchange::AgentStatus>(&message);
  if (status == nullptr || status->role != exchange::AgentRole::kFollower) return;
  if (status->mode == exchange::AgentMode::kStopped) {
    heard_.Erase(status->agent);
  } else {
    heard_.Touch(status->agent) = status->battery_percent;
  }
}

exchange::NetworkReply ScheduleRegistry::Change(const exchange::NetworkEdit& edit,
                                                std::int64_t now_unix_ms) {
  auto& answered = answered_.Touch({edit.client, edit.request});
  if (answered) return *answered;
  exchange::NetworkReply reply{.server = server_, .client = edit.client, .request = edit.request};
  auto lines = Carry(edit.words, edit.client, now_unix_ms);
  if (lines) {
    reply.lines = *std::move(lines);
  } else {
    reply.error = PlainText(lines.error().message, exchange::kMaxLineBytes);
  }
  answered = reply;
  return reply;
}

Result<Lines> ScheduleRegistry::Carry(const std::string& words, const AgentId& client,
                                      std::int64_t now_unix_ms) {
  auto edit = schedule::ParseScheduleEdit(words);
  if (!edit) return tl::unexpected(edit.error());
  const std::string by = WithoutProcess(client.value());
  const std::string name = edit->schedule.name;
  const auto known = entries_.find(name);
  using Kind = schedule::Edit::Kind;
  Result<void> done;
  if (edit->kind == Kind::kAdd) {
    done = Add(std::move(edit->schedule), by, now_unix_ms);
  } else if (known == entries_.end()) {
    return Fail(ErrorCode::kNotFound,
                "no schedule is called '{}' here: 'trailcast schedule list' shows what there is",
                name);
  } else if (edit->kind == Kind::kChange) {
    done = Replace(known->second, std::move(edit->schedule), by, now_unix_ms);
  } else if (edit->kind == Kind::kRemove) {
    done = store_.ForgetSchedule(name);
    if (done) entries_.erase(known);
  } else {
    done =
        edit->kind == Kind::kPause ? Pause(known->second, by) : Resume(known->second, now_unix_ms);
  }
  if (!done) return tl::unexpected(done.error());
  static constexpr const char* kDone[] = {"adds", "changes", "removes", "pauses", "resumes"};
  notes_.push_back(
      fmt::format("'{}' {} schedule {}", by, kDone[static_cast<std::size_t>(edit->kind)], name));
  const auto now_is = entries_.find(name);
  return now_is == entries_.end() ? Lines{} : LinesOf(ListedAs(now_is->second));
}

Result<void> ScheduleRegistry::Add(schedule::Schedule schedule, const std::string& by,
                                   std::int64_t now_unix_ms) {
  if (const auto known = entries_.find(schedule.name); known != entries_.end()) {
    if (known->second.schedule == schedule) return {};
    return Fail(
        ErrorCode::kConflict,
        "there is a schedule {} already, {}: change that, remove it first, or take another name",
        schedule.name, WhenText(known->second.schedule));
  }
  if (entries_.size() >= kMostSchedules) {
    return Fail(ErrorCode::kUnavailable, "there are {} schedules already: remove some",
                kMostSchedules);
  }
  Entry entry;
  entry.kept = {
      .name = schedule.name, .words = ToText(schedule), .by = by, .looked_unix_ms = now_unix_ms};
  if (auto comes = CheckThatItComes(schedule, now_unix_ms); !comes) return comes;
  entry.schedule = std::move(schedule);
  if (auto kept = Keep(entry, entry.kept); !kept) return kept;
  entries_.emplace(entry.schedule.name, std::move(entry));
  return {};
}

Result<void> ScheduleRegistry::Replace(Entry& entry, schedule::Schedule schedule,
                                       const std::string& by, std::int64_t now_unix_ms) {
  if (entry.schedule == schedule) return {};
  if (auto comes = CheckThatItComes(schedule, now_unix_ms); !comes) return comes;
  Kept kept = entry.kept;
  kept.words = ToText(schedule);
  kept.by = by;
  kept.looked_unix_ms = now_unix_ms;
  if (auto stored = store_.Put(kept); !stored) return stored;
  entry = {.schedule = std::move(schedule), .kept = std::move(kept)};
  entry.next_unix_ms = NextDue(entry.schedule, now_unix_ms);
  return {};
}

Result<void> ScheduleRegistry::Pause(Entry& entry, const std::string& by) {
  if (!entry.kept.paused_by.empty()) return {};
  Kept kept = entry.kept;
  kept.paused_by = by;
  return Keep(entry, std::move(kept));
}

// Times that have passed meanwhile are not missed, and missions that did not arrive no longer keep
// their robots from being sent.
Result<void> ScheduleRegistry::Resume(Entry& entry, std::int64_t now_unix_ms) {
  Kept kept = entry.kept;
  if (!kept.paused_by.empty()) kept.looked_unix_ms = now_unix_ms;
  kept.paused_by.clear();
  std::erase_if(kept.sent, [&](const Kept::Sent& sent) {
    const auto last = LastReport(sent.agent, sent.mission);
    return !last || (mission::HasEnded(last->state) && last->state != mission::State::kArrived);
  });
  return Keep(entry, std::move(kept));
}

Result<void> ScheduleRegistry::Keep(Entry& entry, Kept kept) {
  if (auto stored = store_.Put(kept); !stored) return stored;
  entry.kept = std::move(kept);
  entry.next_unix_ms = NextDue(entry.schedule, entry.kept.looked_unix_ms);
  entry.waits_since.reset();
  return {};
}

exchange::NetworkReply ScheduleRegistry::Answer(const exchange::NetworkRequest& request) {
  exchange::NetworkReply reply{
      .server = server_, .client = request.client, .request = request.request};
  Lines all;
  for (const auto& [name, entry] : entries_) {
    Lines lines = LinesOf(ListedAs(entry));
    std::move(lines.begin(), lines.end(), std::back_inserter(all));
  }
  const std::size_t begin = std::min<std::size_t>(request.first, all.size());
  const std::size_t end = std::min(begin + exchange::kMaxNetworkLines, all.size());
  reply.lines.assign(all.begin() + static_cast<std::ptrdiff_t>(begin),
                     all.begin() + static_cast<std::ptrdiff_t>(end));
  if (end < all.size()) reply.next = static_cast<std::uint32_t>(end);
  return reply;
}

schedule::Listed ScheduleRegistry::ListedAs(const Entry& entry) {
  const Kept& kept = entry.kept;
  schedule::Listed listed{.schedule = entry.schedule,
                          .by = kept.by,
                          .paused_by = kept.paused_by,
                          .outcome = kept.outcome};
  if (kept.paused_by.empty()) listed.next_unix_ms = entry.next_unix_ms;
  if (kept.last_unix_ms != 0) listed.last_unix_ms = kept.last_unix_ms;
  for (const Kept::Sent& sent : kept.sent) {
    const auto last = LastReport(sent.agent, sent.mission);
    const std::string outcome = !sent.why.empty() ? "not sent: " + sent.why
                                : last            ? Became(*last)
                                                  : "what became of it is no longer kept";
    listed.sent.push_back(
        {sent.agent.value(), sent.mission, PlainText(outcome, kMostOutcomeBytes)});
  }
  return listed;
}

std::optional<mission::Report> ScheduleRegistry::LastReport(const AgentId& agent,
                                                            const std::string& mission) {
  if (mission.empty()) return std::nullopt;
  const auto found = store_.Get(agent, mission);
  if (!found || !*found) return std::nullopt;
  return (*found)->last;
}

void ScheduleRegistry::Tick(Time now, std::int64_t now_unix_ms) {
  if (!began_) began_ = now;
  if (look_at_ && now < *look_at_) return;
  look_at_ = now + kLookAtAllEvery;
  for (auto& [name, entry] : entries_) Look(entry, now, now_unix_ms);
}

void ScheduleRegistry::Look(Entry& entry, Time now, std::int64_t now_unix_ms) {
  Kept& kept = entry.kept;
  if (!kept.paused_by.empty()) return;
  if (kept.looked_unix_ms > now_unix_ms + kAhead.count()) {
    notes_.push_back(fmt::format("schedule {}: the clock was set back, to {}", kept.name,
                                 schedule::TextIn(entry.schedule.zone, now_unix_ms)));
    kept.looked_unix_ms = now_unix_ms;
    entry.next_unix_ms = NextDue(entry.schedule, now_unix_ms);
    entry.waits_since.reset();
  }
  if (!entry.next_unix_ms || now_unix_ms < *entry.next_unix_ms) return;
  const auto due = LastDue(entry.schedule, kept.looked_unix_ms, now_unix_ms);
  if (!due) return;
  const bool is_missed = now_unix_ms - *due > kOnTime.count();
  if (is_missed && entry.schedule.missed == schedule::Missed::kSkip) {
    Conclude(entry, *due,
             fmt::format("missed: it could not be sent before {}",
                         schedule::TextIn(entry.schedule.zone, now_unix_ms)),
             kept.sent);
    return;
  }
  Fire(entry, *due, now, now_unix_ms);
}

std::set<AgentId> ScheduleRegistry::RobotsOf(const schedule::Schedule& schedule) const {
  std::set<AgentId> robots;
  for (const std::string& word : schedule.robots) {
    if (!schedule::IsPattern(word)) robots.emplace(word);
  }
  for (const auto& [agent, battery] : heard_) {
    if (robots.size() >= kMostRobotsEach) break;
    const bool is_meant = std::any_of(
        schedule.robots.begin(), schedule.robots.end(),
        [&, &name = agent.value()](const auto& word) { return schedule::IsMeant(word, name); });
    if (is_meant) robots.insert(agent);
  }
  return robots;
}

ScheduleRegistry::Verdict ScheduleRegistry::JudgeRobot(const Entry& entry, const AgentId& agent,
                                                       const std::string& mission) {
  const Kept::Sent* before = SentTo(entry.kept, agent);
  if (before != nullptr && before->mission != mission) {
    const auto last = LastReport(agent, before->mission);
    if (last && !mission::HasEnded(last->state)) {
      return {agent,
              fmt::format("the one before, {}, has not ended: {}", before->mission, Became(*last))};
    }
    if (entry.schedule.if_arrived && last && last->state != mission::State::kArrived) {
      return {agent, fmt::format("the last one, {}, did not arrive ({}): resume the schedule to "
                                 "send it again",
                                 before->mission, mission::ToString(last->state))};
    }
  }
  if (!entry.schedule.battery_percent) return {agent};
  const auto* battery = heard_.Find(agent);
  if (battery == nullptr) return {agent, "it is not heard, so that its battery is not known", true};
  if (!*battery) return {agent, "it does not tell how its battery is", true};
  if (**battery >= *entry.schedule.battery_percent) return {agent};
  return {agent, fmt::format("its battery is at {} %, below {} %", **battery,
                             *entry.schedule.battery_percent)};
}

std::vector<ScheduleRegistry::Verdict> ScheduleRegistry::Judge(const Entry& entry,
                                                               const std::string& mission) {
  std::vector<Verdict> verdicts;
  for (const AgentId& agent : RobotsOf(entry.schedule)) {
    verdicts.push_back(JudgeRobot(entry, agent, mission));
  }
  return verdicts;
}

bool ScheduleRegistry::MayMissSome(const schedule::Schedule& schedule, Time now) const {
  return now - *began_ < kPatience &&
         std::any_of(schedule.robots.begin(), schedule.robots.end(), schedule::IsPattern);
}

void ScheduleRegistry::Fire(Entry& entry, std::int64_t due_unix_ms, Time now,
                            std::int64_t now_unix_ms) {
  const schedule::Schedule& schedule = entry.schedule;
  if (!entry.waits_since) entry.waits_since = now;
  const bool may_wait = now - *entry.waits_since < kPatience;
  if (schedule.unless_closed) {
    if (std::string closed = site_.closed(schedule.orders); !closed.empty()) {
      return Conclude(entry, due_unix_ms, std::move(closed), entry.kept.sent);
    }
  }
  const std::string id = MissionId(schedule, due_unix_ms);
  const std::vector<Verdict> verdicts = Judge(entry, id);
  const bool perhaps =
      verdicts.empty() || MayMissSome(schedule, now) ||
      std::any_of(verdicts.begin(), verdicts.end(), [](const auto& each) { return each.perhaps; });
  if (perhaps && may_wait) return;
  std::vector<mission::Mission> missions;
  for (const Verdict& verdict : verdicts) {
    if (!verdict.why_not.empty()) continue;
    missions.push_back({.agent = verdict.agent,
                        .id = id,
                        .client = AgentId(entry.kept.by),
                        .orders = MissionOrders(schedule),
                        .valid_for_s = schedule.valid_s,
                        .goes_on = schedule.goes_on});
  }
  if (!missions.empty()) site_.take(missions, now, now_unix_ms);
  // Missions that could not be stored are sent anew, and so are those that were, which stay as
  // they are.
  for (const mission::Mission& mission : missions) {
    if (!LastReport(mission.agent, id)) return;
  }
  std::vector<Kept::Sent> sent;
  for (const Verdict& verdict : verdicts) {
    const Kept::Sent* before = SentTo(entry.kept, verdict.agent);
    const bool is_sent = verdict.why_not.empty();
    sent.push_back({.agent = verdict.agent,
                    .mission = is_sent             ? id
                               : before == nullptr ? ""
                                                   : before->mission,
                    .why = verdict.why_not});
  }
  Conclude(entry, due_unix_ms,
           verdicts.empty() ? fmt::format("there was nobody to send to: no robot '{}' is heard",
                                          fmt::join(schedule.robots, ","))
                            : "",
           std::move(sent));
}

// An outcome that cannot be stored holds here all the same. After a restart the time may be seen to
// again, which sends the same missions.
void ScheduleRegistry::Conclude(Entry& entry, std::int64_t due_unix_ms, std::string outcome,
                                std::vector<Kept::Sent> sent) {
  Kept kept = entry.kept;
  kept.looked_unix_ms = due_unix_ms;
  kept.last_unix_ms = due_unix_ms;
  kept.outcome = std::move(outcome);
  kept.sent = std::move(sent);
  std::string news = fmt::format("schedule {}, due {}", kept.name,
                                 schedule::TextIn(entry.schedule.zone, due_unix_ms));
  if (!kept.outcome.empty()) news += ": nobody is sent: " + kept.outcome;
  for (const Kept::Sent& each : kept.outcome.empty() ? kept.sent : std::vector<Kept::Sent>{}) {
    news += fmt::format("; '{}' {}{}", each.agent.value(),
                        each.why.empty() ? "is sent " : "is not sent: ",
                        each.why.empty() ? each.mission : each.why);
  }
  notes_.push_back(PlainText(news, exchange::kMaxLineBytes));
  if (const auto stored = Keep(entry, kept); !stored) {
    notes_.push_back(stored.error().message);
    entry.kept = std::move(kept);
    entry.next_unix_ms = NextDue(entry.schedule, due_unix_ms);
    entry.waits_since.reset();
  }
}

}  // namespace trailcast::server
