#include "route_server/network/replanning.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "route_server/network/robot_way.h"
#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"

namespace trailcast::server {
namespace {

using mission::Task;
using network::Section;

// Two sections of which one continues where the other ends are one to a robot.
void Append(std::vector<Section>& way, const Section& next) {
  const bool is_none = next.length_m() <= NetworkRegistry::kSame_m && next.turn_rad == 0.0;
  if (is_none && !way.empty()) return;
  if (!way.empty() && GoesOn(way.back(), next) && way.back().speed == next.speed) {
    way.back().to_m = next.to_m;
  } else {
    way.push_back(next);
  }
}

// Says whether it reports that it stands off its last path.
bool AsksForWay(const mission::Record& record) {
  const auto going = mission::GoingIn(record.mission.orders);
  return going && record.last.state == mission::State::kFetching &&
         record.last.waits_for == mission::WaitsFor::kWay && record.last.way == going->way;
}

}  // namespace

// The rest of a robot's path.
struct Replanning::Rest {
  mission::Going going{};  // without a destination if it was sent along routes by hand
  std::vector<Section> sections{};
  std::optional<NetworkRegistry::Stand> stand{};  // its place, if it has reported one
  bool missed = false;                            // it is off its path,
  bool passed = false;                         // and past the place where it had to leave its route
  bool waits = false;                          // for a path
  std::optional<network::Condition> closed{};  // the first closed section on its path
  std::optional<network::Condition> around{};  // the closed section in which it is
};

// A new path from the robot's place.
struct Replanning::Plan {
  std::vector<Section> way{};
  std::string no_way{};  // if not empty, there is no path, and the sections lead to where it waits
};

std::vector<std::string> Replanning::LookAtAll(Time now) {
  std::vector<std::string> lines;
  for (const AgentId& agent : missions_.AtWork()) {
    if (std::string line = Look(agent, now); !line.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::string Replanning::Look(const AgentId& agent, Time now) {
  const mission::Record* record = missions_.CurrentOf(agent);
  if (record == nullptr) return {};
  Seen& seen = seen_.Touch(agent);
  if (seen.mission != record->mission.id) seen = {.mission = record->mission.id};
  const bool is_news = seen.changes != network_.changes();
  const bool may_rest = seen.settled && !AsksForWay(*record);
  if (!is_news && (may_rest || now - seen.looked_at < kLookEvery)) return {};
  const std::string who = fmt::format("{}: mission {} ", agent.value(), record->mission.id);
  const auto said = [&](const std::string& text) {
    return PlainText(who + text, exchange::kMaxLineBytes);
  };
  const auto rest = RestOf(*record);
  seen.changes = network_.changes();
  seen.looked_at = now;
  seen.settled = true;
  if (!rest) return said("cannot be planned anew: " + rest.error().message);
  if (rest->going.to.empty()) {
    if (!rest->closed) return {};
    return said(fmt::format("leads over {} and was sent by hand: it is not stopped",
                            network_.Called(*rest->closed)));
  }
  seen.settled = rest->stand && (rest->waits || rest->going.way == 1);
  if (rest->missed && now - seen.amended_at < kAgainAfter) return {};
  if (!rest->closed && !rest->waits && !rest->missed) {
    if (!rest->around || !is_news) return {};
    return said("is on " + network_.Called(*rest->around) + " and drives on out of it");
  }
  const auto text = Replan(*record, *rest);
  if (!text) return is_news ? said(text.error().message) : "";
  if (text->empty()) return {};
  seen.amended_at = now;
  seen.settled = false;
  return said(*text);
}

Result<Replanning::Rest> Replanning::RestOf(const mission::Record& record) {
  const auto tasks = mission::ParseOrders(record.mission.orders);
  if (!tasks) return tl::unexpected(tasks.error());
  Rest rest;
  rest.going = mission::GoingIn(record.mission.orders).value_or(mission::Going{});
  rest.waits = tasks->back().kind == Task::Kind::kWaitWay;
  std::vector<Section> all;
  std::size_t said = 0;  // index of the one that it reports
  bool laps = false;
  for (std::size_t i = 0; i < tasks->size(); ++i) {
    if (i == record.last.task) said = all.size();
    if ((*tasks)[i].kind != Task::Kind::kFollow) continue;
    auto section = network_.SectionOf(*tasks, i);
    if (!section) return tl::unexpected(section.error());
    laps |= i == record.last.task && (*tasks)[i].laps > 1;
    all.push_back(*std::move(section));
  }
  if (const auto* stand = network_.StandOf(record.mission.agent)) rest.stand = *stand;
  if (!rest.waits && AsksForWay(record)) {
    if (rest.stand && !rest.stand->now) rest.stand.reset();
    rest.missed = rest.stand.has_value();
    rest.passed = rest.missed && !all.empty() && rest.stand->place.route == all.front().route &&
                  all.front().DrivenAt(rest.stand->place.along_m) > all.front().length_m();
  } else {
    const bool drives = record.last.state == mission::State::kUnderWay ||
                        record.last.state == mission::State::kPaused;
    TakeFrom(all, said, drives, laps, rest);
  }
  for (const Section& section : rest.sections) {
    auto closed = network_.FirstClosed(section);
    if (!closed) return tl::unexpected(closed.error());
    if (!*closed) continue;
    rest.closed = **closed;
    break;
  }
  if (rest.stand) {
    auto around = network_.ClosedAround(rest.stand->place);
    if (!around) return tl::unexpected(around.error());
    rest.around = *std::move(around);
  }
  return rest;
}

// Takes the rest of all its sections from its place on; `said` is the index that it reports.
void Replanning::TakeFrom(const std::vector<Section>& all, std::size_t said, bool drives, bool laps,
                          Rest& rest) {
  auto at = all.begin() + static_cast<std::ptrdiff_t>(said);
  if (rest.stand && at != all.end()) {
    const auto holds = [&](const Section& each) { return Holds(each, rest.stand->place); };
    rest.missed =
        rest.going.way > 1 && rest.stand->place.route == all.front().route &&
        all.front().DrivenAt(rest.stand->place.along_m) > all.front().length_m() + kBeyond_m &&
        std::none_of(all.begin(), all.end(), holds);
    rest.passed = rest.missed;
    // Its report may be from before it began to drive.
    const auto found = holds(*at) || !drives ? at : std::find_if(all.begin(), all.end(), holds);
    if (found != all.end()) at = found;
    if (!rest.missed && !holds(*at)) rest.stand.reset();
  }
  rest.sections.assign(at, all.end());
  if (!rest.sections.empty() && rest.stand && !rest.missed && !laps) {
    rest.sections.front().BeginAt(rest.stand->place.along_m);
  }
}

Result<Replanning::Plan> Replanning::PlanOn(const Rest& rest, double ahead_m) {
  Plan plan;
  network::Place from;
  if (rest.missed || rest.sections.empty()) {
    if (!rest.stand)
      return Fail(ErrorCode::kUnavailable, "waits for a way, and has not said where it stands");
    from = rest.stand->place;
  } else {
    for (const Section& section : rest.sections) {
      const auto closed = network_.FirstClosed(section);
      if (!closed) return tl::unexpected(closed.error());
      double kept_m = std::min(section.length_m(), ahead_m);
      if (*closed) {
        const double closed_m = section.backwards() ? (**closed).to_m : (**closed).from_m;
        kept_m = std::clamp(section.DrivenAt(closed_m), 0.0, kept_m);
      }
      Section kept = section;
      kept.to_m = section.AlongAfter(kept_m);
      from = {kept.route, kept.to_m};
      if (kept_m > 0.0) Append(plan.way, kept);
      ahead_m -= kept_m;
      if (kept_m < section.length_m() || ahead_m <= 0.0) break;
    }
  }
  auto on = network_.WayOn(from, rest.going.to);
  if (!on && rest.missed) {  // it stands, and may be on several routes, of which it has reported
                             // one
    const auto also = network_.AlsoAt(from);
    if (!also) return tl::unexpected(also.error());
    for (std::size_t i = 0; !on && i < also->size(); ++i) {
      if (auto by = network_.WayOn((*also)[i], rest.going.to)) on = std::move(by);
    }
  }
  if (on) {
    for (const Section& section : *on) Append(plan.way, section);
    return plan;
  }
  plan.no_way = on.error().message;
  plan.way.clear();
  if (rest.around) {
    plan.way = {{.route = rest.around->route,
                 .from_m = rest.stand->place.along_m,
                 .to_m = rest.around->to_m}};
  }
  return plan;
}

Result<std::string> Replanning::Replan(const mission::Record& record, const Rest& rest) {
  // It drives on for a while before it can hear of another path, so that part stays. If it leads
  // nowhere, the robot may still hear of the change sooner.
  const double speed_mps = rest.stand ? rest.stand->speed_mps : 0.0;
  auto plan = PlanOn(rest, speed_mps > 0.0 ? kHearsWithin_s * speed_mps + kTakesPlace_m : 0.0);
  if (plan && !plan->no_way.empty() && speed_mps > 0.0) plan = PlanOn(rest, 0.0);
  if (!plan) return tl::unexpected(plan.error());
  const bool has_way = plan->no_way.empty();
  // It begins where it is sent to begin, and is looked at again then.
  if (!has_way && !rest.stand) return std::string();
  if (!has_way && rest.waits && !rest.closed && !rest.missed) return std::string();
  std::string because = rest.closed   ? network_.Called(*rest.closed) + " was closed"
                        : rest.passed ? "it had passed where it was to leave its route"
                        : rest.missed ? "it has found itself elsewhere"
                                      : "there is a way";
  if (!has_way) because += "; " + plan->no_way;
  auto planned = network_.TasksOf(plan->way, network_.HeldBy(record.mission.agent));
  if (!planned) return tl::unexpected(planned.error());
  std::vector<Task>& tasks = *planned;
  if (!has_way) tasks.push_back({.kind = Task::Kind::kWaitWay});
  if (tasks.empty()) return std::string();  // it is there
  std::string orders = NextWay(rest.going, tasks, mission::Going::Why::kReplanned, because);
  if (orders.size() > exchange::kMaxLineBytes) {
    because +=
        fmt::format("; the other path has {} sections, more than one mission holds", tasks.size());
    tasks = {{.kind = Task::Kind::kWaitWay}};
    orders = NextWay(rest.going, tasks, mission::Going::Why::kReplanned, because);
  }
  if (auto amended = missions_.Amend(record.mission.agent, orders); !amended) {
    return tl::unexpected(amended.error());
  }
  const bool waits = tasks.back().kind == Task::Kind::kWaitWay;
  return fmt::format("{}: {}: {}", waits ? "waits for a way" : "is re-planned", because,
                     mission::ToText(tasks));
}

}  // namespace trailcast::server
