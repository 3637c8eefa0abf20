#include "route_server/network/zone_admission.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "route_server/network/robot_way.h"
#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"

namespace trailcast::server {
namespace {

using mission::State;
using mission::Task;
using network::Leg;
using network::Section;
using LaneSet = NetworkRegistry::LaneSet;
using Why = mission::Going::Why;

LaneSet Without(const LaneSet& all, const LaneSet& those) {
  LaneSet left;
  std::set_difference(all.begin(), all.end(), those.begin(), those.end(),
                      std::inserter(left, left.end()));
  return left;
}

LaneSet Common(const LaneSet& a, const LaneSet& b) {
  LaneSet both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(both, both.end()));
  return both;
}

LaneSet With(LaneSet some, const LaneSet& others) {
  some.insert(others.begin(), others.end());
  return some;
}

// Returns the metres along the path of a place that is within `within_m` of it.
std::optional<double> FindOn(const std::vector<Section>& way, double within_m,
                             const network::Place& place) {
  double before_m = 0.0;
  for (const Section& section : way) {
    const double driven_m = section.DrivenAt(place.along_m);
    const bool is_on =
        place.route == section.route && driven_m >= 0.0 && driven_m <= section.length_m();
    if (is_on && before_m + driven_m <= within_m) return before_m + driven_m;
    before_m += section.length_m();
  }
  return std::nullopt;
}

// Says whether it may wait at a place that is no mutex zone any more.
bool MayWait(const mission::Record* record) {
  if (record == nullptr) return false;
  const auto tasks = mission::ParseOrders(record->mission.orders);
  return tasks && std::any_of(tasks->begin(), tasks->end(),
                              [](const Task& task) { return task.kind == Task::Kind::kWaitLane; });
}

std::string Who(const mission::Record& record) {
  return fmt::format("{}: mission {} ", record.mission.agent.value(), record.mission.id);
}

}  // namespace

// The rest of a robot's path.
struct ZoneAdmission::Rest {
  mission::Going going{};        // without a destination if it was sent along routes by hand
  std::vector<Section> now{};    // what it may drive,
  std::vector<Section> later{};  // and what follows once it is let in
  bool may_ask = false;          // it has heard of these orders and is at their end,
  bool stands = false;           // or reports that it stands there
  bool heard = false;
  bool placed = false;  // its place is known
  double speed_mps = 0.0;

  [[nodiscard]] bool backwards() const {
    const std::vector<Section>& next = now.empty() ? later : now;
    return !next.empty() && next.front().backwards();
  }
};

ZoneAdmission::Lines ZoneAdmission::LookAtAll(Time now) {
  Lines lines;
  if (!since_) since_ = now;
  if (!network_.HasLanes()) return lines;
  // Their orders may still let them drive on in the zone, so they are told to wait, if they ever
  // hear it.
  for (const AgentId& agent : network_.TakeVacated()) {
    const mission::Record* record = missions_.CurrentOf(agent);
    if (record == nullptr) continue;
    const auto barred = RestOf(*record, robots_.Touch(agent)).and_then([&](const Rest& rest) {
      return rest.going.to.empty() ? Result<void>() : Bar(*record, rest, lines);
    });
    if (!barred) lines.push_back(Who(*record) + barred.error().message);
  }
  for (const AgentId& agent : missions_.AtWork()) {
    const auto settled = Settle(agent, robots_.Touch(agent), now, lines);
    if (!settled) lines.push_back(fmt::format("{}: {}", agent.value(), settled.error().message));
  }
  return lines;
}

ZoneAdmission::Lines ZoneAdmission::Look(const AgentId& agent, Time now) {
  Lines lines;
  if (!network_.HasLanes() && !MayWait(missions_.CurrentOf(agent))) return lines;
  robots_.Touch(agent).heard_at = now;
  auto left = Settle(agent, robots_.Touch(agent), now, lines);
  std::vector<std::pair<Time, AgentId>> asking;
  for (const auto& [other, robot] : robots_) {
    const bool asks = left && *left && robot.waits_since;
    if (asks && other != agent) asking.emplace_back(*robot.waits_since, other);
  }
  asking.emplace_back(robots_.Touch(agent).waits_since.value_or(now), agent);
  std::sort(asking.begin(), asking.end());
  for (const auto& [since, other] : asking) {
    if (!left) break;
    if (auto let = LetIn(other, robots_.Touch(other), now, lines); !let) {
      left = tl::unexpected(let.error());
    }
  }
  if (!left) lines.push_back(fmt::format("{}: {}", agent.value(), left.error().message));
  for (std::string& line : lines) line = PlainText(line, exchange::kMaxLineBytes);
  return lines;
}

Result<ZoneAdmission::Rest> ZoneAdmission::RestOf(const mission::Record& record, Robot& robot) {
  const auto& [sent, last, sent_ms, changed_ms] = record;
  if (robot.mission != sent.id || robot.orders != sent.orders) {
    robot.mission = sent.id;
    robot.orders = sent.orders;
    robot.at = 0;
    robot.driven_m = 0.0;
  }
  const auto tasks = mission::ParseOrders(sent.orders);
  if (!tasks) return tl::unexpected(tasks.error());
  Rest rest;
  rest.going = mission::GoingIn(sent.orders).value_or(mission::Going{});
  bool waits = false;
  bool laps = false;
  for (std::size_t i = 0; i < tasks->size(); ++i) {
    const Task& task = (*tasks)[i];
    waits |= task.kind == Task::Kind::kWaitLane;
    laps |= task.laps > 1;
    if (task.kind != Task::Kind::kFollow) continue;
    auto section = network_.SectionOf(*tasks, i);
    if (!section) return tl::unexpected(section.error());
    (waits ? rest.later : rest.now).push_back(*std::move(section));
  }
  rest.heard = last.way >= rest.going.way;
  // Its report may be from before it began to drive.
  const bool drives = last.state == State::kUnderWay || last.state == State::kPaused ||
                      (rest.heard && rest.going.way > 1);
  const auto* stand = network_.StandOf(sent.agent);
  const bool is_placed = drives && stand != nullptr && stand->now;
  bool is_on = rest.now.empty();
  if (is_placed && !laps) {
    rest.speed_mps = stand->speed_mps;
    const auto begin = rest.now.begin() + static_cast<std::ptrdiff_t>(robot.at);
    const auto found = std::find_if(begin, rest.now.end(),
                                    [&](const Section& each) { return Holds(each, stand->place); });
    is_on |= found != rest.now.end();
    if (found != rest.now.end()) {
      robot.at = static_cast<std::size_t>(found - rest.now.begin());
      robot.driven_m = found->DrivenAt(stand->place.along_m);
      rest.placed = true;
    }
  }
  if (robot.at < rest.now.size()) {
    Section& first = rest.now[robot.at];
    first.BeginAt(first.AlongAfter(robot.driven_m));
  }
  rest.now.erase(rest.now.begin(), rest.now.begin() + static_cast<std::ptrdiff_t>(robot.at));
  rest.stands = rest.heard && last.state == State::kFetching && last.task < tasks->size() &&
                (*tasks)[last.task].kind == Task::Kind::kWaitLane;
  if (rest.stands) {
    rest.now.clear();
    is_on = true;
  }
  rest.may_ask = waits && is_on && rest.heard && last.state != State::kPaused &&
                 !rest.going.to.empty() && LengthOf(rest.now) <= kThere_m;
  return rest;
}

Result<bool> ZoneAdmission::Settle(const AgentId& agent, Robot& robot, Time now, Lines& lines) {
  const auto lanes = network_.Lanes();
  if (!lanes) return tl::unexpected(lanes.error());
  const mission::Record* record = missions_.CurrentOf(agent);
  const auto* stand = network_.StandOf(agent);
  const LaneSet held = network_.HeldBy(agent);
  std::optional<Rest> rest;
  if (record != nullptr) {
    auto left = RestOf(*record, robot);
    if (!left) return tl::unexpected(left.error());
    rest = *std::move(left);
  }
  LaneSet in;
  if (stand != nullptr) {
    const bool backwards = rest && rest->backwards();
    in = network::LanesAt(stand->place, *lanes, backwards);
    // A robot that holds a zone and stopped at its very beginning still holds it.
    in.merge(Common(held, network::LanesAt(stand->place, *lanes, backwards, 0.0)));
  }
  LaneSet has = in;
  bool heard = true;
  bool by_hand = false;
  if (rest) {
    has.merge(network::LanesOn(rest->now, *lanes));
    heard = rest->heard;
    by_hand = rest->going.to.empty();
    // If its place is not known yet, a zone behind it may look as if it were ahead.
    if (!by_hand && !rest->placed) has = With(Common(has, held), in);
    // The zone was made after the robot was sent. The robot holds it until it has heard that it
    // must wait.
    if (!by_hand && !Without(has, With(held, in)).empty()) {
      if (auto barred = Bar(*record, *rest, lines); !barred) return tl::unexpected(barred.error());
    }
  } else {
    robot.waits_since.reset();
  }
  if (const LaneSet more = Without(has, held); !more.empty()) {
    if (auto holds = network_.Hold(more, agent); !holds) return tl::unexpected(holds.error());
    for (const std::size_t lane : more) {
      for (const AgentId& other : network_.HoldersOf(lane)) {
        if (other == agent) continue;
        lines.push_back(fmt::format("{} {} {}, which {} has: it is not stopped", agent.value(),
                                    in.contains(lane) ? "is in"
                                    : by_hand         ? "was sent by hand over"
                                                      : "is on its way over",
                                    network_.Called(lane), other.value()));
      }
    }
  }
  const LaneSet left = Without(held, has);
  // Nothing is known of its place until it has reported it.
  const bool is_sure = heard && stand != nullptr;
  const LaneSet out_of = is_sure ? left : LaneSet{};
  if (robot.out_of != out_of) {
    robot.out_of = out_of;
    robot.out_since = now;
  }
  if (robot.out_of.empty() || now - robot.out_since < kSettled) return false;
  if (auto released = network_.Release(left, agent); !released) {
    return tl::unexpected(released.error());
  }
  for (const std::size_t lane : left) {
    lines.push_back(fmt::format("{} has left {}", agent.value(), network_.Called(lane)));
  }
  return true;
}

// Orders the robot to wait before zones that it may not enter.
Result<void> ZoneAdmission::Bar(const mission::Record& record, const Rest& rest, Lines& lines) {
  std::vector<Section> way = rest.now;
  way.insert(way.end(), rest.later.begin(), rest.later.end());
  const double ahead_m =
      rest.speed_mps > 0.0 ? kHearsWithin_s * rest.speed_mps + kTakesPlace_m : 0.0;
  const auto lanes = network_.Lanes();
  if (!lanes) return tl::unexpected(lanes.error());
  const auto legs = network::LegsOf(way, *lanes, network_.HeldBy(record.mission.agent), ahead_m);
  const LaneSet before = network::LanesOn(rest.now, *lanes);
  const LaneSet after = network::LanesOn(legs.front().sections, *lanes);
  const LaneSet barred = Without(before, after);
  if (barred.empty()) return {};  // it is too near to be told
  const std::vector<Task> tasks = network_.TasksOf(legs);
  const std::string because = network_.Called(*barred.begin()) + " is narrow";
  lines.push_back(
      fmt::format("{}is told to wait: {}: {}", Who(record), because, mission::ToText(tasks)));
  return Amend(record, rest, tasks, Why::kReplanned, because);
}

Result<void> ZoneAdmission::LetIn(const AgentId& agent, Robot& robot, Time now, Lines& lines) {
  const mission::Record* record = missions_.CurrentOf(agent);
  if (record == nullptr) return {};
  auto rest = RestOf(*record, robot);
  if (!rest) return tl::unexpected(rest.error());
  if (!rest->may_ask) {
    robot.waits_since.reset();
    return {};
  }
  const auto lanes = network_.Lanes();
  if (!lanes) return tl::unexpected(lanes.error());
  if (!robot.waits_since) robot.waits_since = now;
  std::vector<Section> way = std::move(rest->now);
  way.insert(way.end(), rest->later.begin(), rest->later.end());
  auto legs = network::LegsOf(way, *lanes, network_.HeldBy(agent));
  const bool stays = legs.size() > 1 && LengthOf(legs.front().sections) <= kThere_m;
  std::optional<WhyNot> why_not;
  std::string because = "enters what is no longer narrow";
  if (stays) {
    // The rest of the first leg belongs to the second.
    Leg& leg = legs[1];
    leg.through_m += LengthOf(legs.front().sections);
    leg.sections.insert(leg.sections.begin(), legs.front().sections.begin(),
                        legs.front().sections.end());
    legs.front().sections.clear();
    why_not = WhyNotInto(agent, leg, now);
    because = "enters " + network_.Called(*leg.lanes.begin());
  }
  if (why_not) {
    const bool is_queued = rest->going.why == Why::kQueued;
    // After the server has started, a robot is assumed to know what holds now.
    if (is_queued && !robot.told) robot.told = why_not;
    const bool is_told = is_queued && robot.told == why_not;
    // While it still drives, the reason may end before it stops.
    if (is_told || !rest->stands) return {};
    const std::string waits = ToText(*why_not);
    lines.push_back(Who(*record) + waits);
    const auto told = Amend(*record, *rest, network_.TasksOf(legs), Why::kQueued, waits);
    if (told) robot.told = why_not;
    return told;
  }
  if (stays) {
    if (auto holds = network_.Hold(legs[1].lanes, agent); !holds) return holds;
    legs.erase(legs.begin());
  }
  robot.waits_since.reset();
  lines.push_back(Who(*record) + because);
  return Amend(*record, *rest, network_.TasksOf(legs), Why::kAdmitted, because);
}

std::optional<ZoneAdmission::WhyNot> ZoneAdmission::WhyNotInto(const AgentId& agent, const Leg& leg,
                                                               Time now) {
  for (const std::size_t lane : leg.lanes) {
    for (const AgentId& other : network_.HoldersOf(lane)) {
      if (other == agent) continue;
      // After the start it may take a while.
      const Robot* robot = robots_.Find(other);
      const Time heard_at =
          robot == nullptr ? since_.value_or(now) : robot->heard_at.value_or(since_.value_or(now));
      return WhyNot{other, network_.Called(lane), now - heard_at > kSilent};
    }
  }
  // There must be room beyond the zone.
  const auto* own = network_.StandOf(agent);
  const auto own_m =
      own == nullptr || !own->now ? std::nullopt : FindOn(leg.sections, leg.through_m, own->place);
  for (const AgentId& other : missions_.AtWork()) {
    const auto* stand = network_.StandOf(other);
    if (other == agent || stand == nullptr || !stand->now) continue;
    const auto at_m = FindOn(leg.sections, leg.through_m, stand->place);
    if (!at_m) continue;
    const double ahead_m = *at_m - own_m.value_or(0.0);
    if (ahead_m < -kBeside_m || (ahead_m < kBeside_m && agent < other)) continue;
    return WhyNot{.other = other};
  }
  return std::nullopt;
}

std::string ZoneAdmission::ToText(const WhyNot& why_not) {
  const auto& [other, lane, is_silent] = why_not;
  if (lane.empty()) {
    return fmt::format("waits for {}, which is ahead of it, to go on", other.value());
  }
  std::string text = fmt::format("waits for {} to leave {}", other.value(), lane);
  if (is_silent) {
    text += fmt::format(
        "; it is not heard: once it is out of it, say 'trailcast network vacate {}'", lane);
  }
  return text;
}

Result<void> ZoneAdmission::Amend(const mission::Record& record, const Rest& rest,
                                  const std::vector<Task>& tasks, Why why,
                                  const std::string& because) {
  const std::string orders = NextWay(rest.going, tasks, why, because);
  if (orders.size() > exchange::kMaxLineBytes) {
    return Fail(ErrorCode::kInvalidArgument,
                "its path has {} sections, more than one mission holds: send it to a place on the "
                "way first",
                tasks.size());
  }
  return missions_.Amend(record.mission.agent, orders);
}

}  // namespace trailcast::server
