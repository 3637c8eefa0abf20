#include "route_server/network/charging.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "route_server/fleet/kept_mission.h"
#include "services/mission/orders.h"

namespace trailcast::server {
namespace {

// The robot is given so long to answer a mission that it could begin.
constexpr std::uint32_t kChargeWithin_s = 600;
// The id of the mission of a robot that leaves a dock to others begins with this.
constexpr const char* kRoomPrefix = "room-";

bool AwaitsDock(const mission::Record& record) {
  return record.mission.orders == OrdersWithoutWay({.to = std::string(kChargeWord)});
}

}  // namespace

void Charging::Check(const Result<void>& done) {
  if (!done) Warn(done.error().message);
}

void Charging::Warn(const std::string& trouble) {
  if (told_.IsDue(trouble, *look_at_)) troubles_.push_back(trouble);
}

void Charging::Hear(const exchange::Message& message) {
  if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    if (Robot* robot = robots_.Find(gone->agent)) robot->is_heard = false;
  }
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    if (status->role != exchange::AgentRole::kFollower) return;
    Robot& robot = robots_.Touch(status->agent);
    robot.is_heard = status->on_duty && status->mode != exchange::AgentMode::kStopped;
    robot.battery_percent = status->battery_percent;
  }
  const auto* command = std::get_if<exchange::NowCommand>(&message);
  if (command == nullptr || command->order != exchange::NowOrder::kResume) return;
  for (auto& [agent, robot] : robots_) {
    if (!missions_.IsMeant(*command, agent)) continue;
    const mission::Record* last = missions_.LastEnded(agent);
    if (last == nullptr || robot.gone_on == last->mission.id) continue;
    robot.gone_on = last->mission.id;
    missions_.NoteQueue(agent);
  }
}

const Charging::Dock* Charging::DockAt(const network::Place& place, double within_m) const {
  const auto holds = [&](const network::Place& each) {
    return each.route == place.route && std::abs(each.along_m - place.along_m) <= within_m;
  };
  const auto found = std::find_if(docks_.begin(), docks_.end(), [&](const Dock& dock) {
    return std::any_of(dock.places.begin(), dock.places.end(), holds);
  });
  return found == docks_.end() ? nullptr : &*found;
}

const Charging::Dock* Charging::DockOf(const mission::Record& record) const {
  const auto going = docks_.empty() ? std::nullopt : mission::GoingIn(record.mission.orders);
  if (!going) return nullptr;
  const auto place = network_.PlaceOf(going->to);
  return place ? DockAt(*place) : nullptr;
}

const mission::Record* Charging::WaitingToCharge(const AgentId& agent) const {
  for (const mission::Record* waiting : missions_.QueueOf(agent)) {
    if (SendsToCharge(*waiting)) return waiting;
  }
  return nullptr;
}

RobotSeen Charging::SeenOf(const AgentId& agent, const Robot& robot) {
  RobotSeen seen{.agent = agent};
  if (robot.is_heard) seen.battery_percent = robot.battery_percent;
  const mission::Record* current = missions_.CurrentOf(agent);
  seen.is_sent =
      WaitingToCharge(agent) != nullptr || (current != nullptr && SendsToCharge(*current));
  if (missions_.IsAtWork(agent)) return seen;
  const mission::Record* last = missions_.LastEnded(agent);
  if (last == nullptr || !SendsToCharge(*last)) return seen;
  const Dock* dock = last->last.state == mission::State::kArrived ? DockOf(*last) : nullptr;
  const auto* stand = network_.StandOf(agent);
  const bool is_there = stand == nullptr || DockAt(stand->place, kBesideDock_m) == dock;
  if (dock != nullptr && is_there && robot.moved_after != last->mission.id) {
    seen.dock = dock->name;
  }
  seen.may_go_on = robot.gone_on == last->mission.id;
  return seen;
}

bool Charging::IsLost(const AgentId& agent) {
  const mission::Record* last = missions_.LastEnded(agent);
  return network_.StandOf(agent) == nullptr ||
         (last != nullptr && last->last.waits_for == mission::WaitsFor::kPlace);
}

void Charging::Hold(Dock& dock, const std::set<AgentId>& holders) {
  Check(network_.HoldDock(dock.name, holders));
  dock.holders = holders;
}

void Charging::NoteHolders() {
  std::set<std::pair<AgentId, const Dock*>> going;
  for (const mission::Record* record : missions_.HandedOver()) {
    going.emplace(record->mission.agent, DockOf(*record));
  }
  std::vector<std::pair<Sighting, const Dock*>> robots;
  for (const auto& [agent, robot] : robots_) {
    const mission::Record* waiting = WaitingToCharge(agent);
    if (waiting != nullptr) going.emplace(agent, DockOf(*waiting));
    // It may have arrived a little beside it.
    if (const mission::Record* last = missions_.LastEnded(agent);
        last != nullptr && !SeenOf(agent, robot).dock.empty()) {
      going.emplace(agent, DockOf(*last));
    }
    const auto* stand = network_.StandOf(agent);
    robots.emplace_back(
        Sighting{.agent = agent, .is_heard = robot.is_heard, .is_placed = stand != nullptr},
        stand == nullptr ? nullptr : DockAt(stand->place));
  }
  for (Dock& dock : docks_) {
    std::vector<Sighting> seen;
    for (const auto& [robot, at] : robots) {
      Sighting& each = seen.emplace_back(robot);
      each.is_there = at == &dock;
      each.goes_there = going.contains({robot.agent, &dock});
    }
    Hold(dock, HoldersNow(dock.holders, seen));
  }
}

void Charging::Tick(Time now, std::int64_t now_unix_ms) {
  if (look_at_ && now < *look_at_) return;
  look_at_ = now + kLookEvery;
  auto docks = network_.Docks();
  if (!docks) {
    Warn(docks.error().message);
    return;
  }
  docks_ = *std::move(docks);
  if (docks_.empty() && !network_.charge_limits() && !was_on_) return;
  was_on_ = network_.charge_limits().has_value();
  for (const AgentId& agent : network_.TakeSentOff()) {
    Robot* robot = robots_.Find(agent);
    const mission::Record* last = missions_.LastEnded(agent);
    if (robot != nullptr && last != nullptr) robot->moved_after = last->mission.id;
  }
  NoteHolders();
  std::vector<AgentId> agents;
  for (const auto& [agent, robot] : robots_) agents.push_back(agent);
  std::sort(agents.begin(), agents.end());
  std::vector<network::Charging> shown;
  for (const AgentId& agent : agents) {
    Robot& robot = *robots_.Find(agent);
    Look(agent, robot, now, now_unix_ms);
    std::string text = TextOf(agent, robot);
    if (!text.empty()) shown.push_back({agent.value(), text});
    if (text != std::exchange(robot.last_text, text)) missions_.NoteQueue(agent);
  }
  MakeRoom(now, now_unix_ms);
  network_.Show(std::move(shown));
}

void Charging::Look(const AgentId& agent, Robot& robot, Time now, std::int64_t now_unix_ms) {
  const auto& limits = network_.charge_limits();
  const RobotSeen seen = SeenOf(agent, robot);
  if (limits && IsToCharge(seen, *limits)) Send(agent, now, now_unix_ms);
  if (limits && !seen.dock.empty() && IsFull(seen, *limits)) {
    robot.gone_on = missions_.LastEnded(agent)->mission.id;
  }
  const mission::Record* waiting = WaitingToCharge(agent);
  if (waiting == nullptr) return;
  if (!limits) {
    missions_.Withdraw(*waiting, "robots are no longer sent to charge", now_unix_ms);
  } else if (IsFull(seen, *limits)) {
    missions_.Withdraw(*waiting, fmt::format("its battery is at {} %", *seen.battery_percent),
                       now_unix_ms);
  } else {
    Choose(agent, robot, *waiting);
  }
}

// A person looks after a mission that did not arrive before its robot is sent on, also to charge.
void Charging::Send(const AgentId& agent, Time now, std::int64_t now_unix_ms) {
  const mission::Record* last = missions_.LastEnded(agent);
  const bool arrived = last == nullptr || last->last.state == mission::State::kArrived;
  const bool is_idle = !missions_.IsAtWork(agent) && missions_.QueueOf(agent).empty();
  if (is_idle && !arrived && missions_.HeldBy(agent).empty()) {
    missions_.Hold(agent, NotArrived(last->last), now_unix_ms);
  }
  const bool is_stored =
      missions_.TakeFirst({.agent = agent,
                           .id = fmt::format("{}{:x}", kChargePrefix, now_unix_ms),
                           .client = server_,
                           .orders = OrdersWithoutWay({.to = std::string(kChargeWord)}),
                           .valid_for_s = kChargeWithin_s},
                          now, now_unix_ms);
  if (!is_stored) Warn(fmt::format("'{}' cannot be sent to charge", agent.value()));
}

void Charging::Choose(const AgentId& agent, Robot& robot, const mission::Record& waiting) {
  if (missions_.IsHanded(agent)) return;
  const bool is_first = missions_.QueueOf(agent).front() == &waiting;
  const bool may_begin = is_first && !missions_.IsAtWork(agent) && missions_.HeldBy(agent).empty();
  if (may_begin && !AwaitsDock(waiting)) {
    const Dock* dock = DockOf(waiting);
    if (dock != nullptr && IsFreeFor(agent, dock->holders)) return;
  }
  robot.no_dock.clear();
  DockChoice choice;
  if (may_begin && IsLost(agent)) {
    choice.why_none = "it does not know where it is";
  } else if (may_begin) {
    const network::Place stand = network_.StandOf(agent)->place;
    std::vector<DockSeen> seen;
    for (const Dock& dock : docks_) {
      DockSeen& each = seen.emplace_back(DockSeen{.name = dock.name, .holders = dock.holders});
      if (!IsFreeFor(agent, dock.holders)) continue;
      const auto way = network_.WayOn(stand, dock.name);
      if (way) each.length_m = network::LengthOf(*way);
      if (!way) each.no_way = way.error().message;
    }
    choice = ChooseDock(agent, seen);
  }
  robot.no_dock = choice.why_none;
  Check(missions_.Direct(waiting, choice.name.empty() ? kChargeWord : choice.name));
  for (Dock& dock : docks_) {
    if (dock.name != choice.name) continue;
    std::set<AgentId> holders = dock.holders;
    holders.insert(agent);
    Hold(dock, holders);
  }
}

std::string Charging::WhyNot(const mission::Record& first) {
  const AgentId& agent = first.mission.agent;
  const Robot* robot = robots_.Find(agent);
  if (robot == nullptr || SendsHome(first)) return "";
  const auto& limits = network_.charge_limits();
  if (SendsToCharge(first)) {
    if (AwaitsDock(first)) return robot->no_dock.empty() ? "a dock is chosen" : robot->no_dock;
  } else if (limits && !first.mission.id.starts_with(kRoomPrefix)) {
    if (const std::string charges = Charges(SeenOf(agent, *robot), *limits); !charges.empty()) {
      return "it " + charges;
    }
  }
  const Dock* dock = DockOf(first);
  if (dock == nullptr) return "";
  std::set<AgentId> holders = dock->holders;
  for (const mission::Record* handed : missions_.HandedOver()) {
    if (DockOf(*handed) == dock) holders.insert(handed->mission.agent);
  }
  if (IsFreeFor(agent, holders)) return "";
  return fmt::format("{} is taken by {}", dock->name, OthersIn(holders, agent));
}

std::string Charging::TextOf(const AgentId& agent, const Robot& robot) {
  const auto& limits = network_.charge_limits();
  if (!limits) return "";
  const RobotSeen seen = SeenOf(agent, robot);
  if (const std::string charges = Charges(seen, *limits); !charges.empty()) return charges;
  if (!seen.is_sent) return "";
  const std::string battery =
      seen.battery_percent ? fmt::format(", its battery is at {} %", *seen.battery_percent) : "";
  if (WaitingToCharge(agent) == nullptr) {
    const auto going = mission::GoingIn(missions_.CurrentOf(agent)->mission.orders);
    return fmt::format("goes to {} to charge{}", going->to, battery);
  }
  const std::string why = missions_.WhyNotNow(agent);
  return fmt::format("is to charge{}{}{}", battery, why.empty() ? "" : "; waits: ", why);
}

// A robot that is full and has nothing to do leaves its dock to one that waits, if there is a home.
void Charging::MakeRoom(Time now, std::int64_t now_unix_ms) {
  const bool others_wait = std::any_of(robots_.begin(), robots_.end(), [&](const auto& each) {
    return WaitingToCharge(each.first) != nullptr && !each.second.no_dock.empty() &&
           !IsLost(each.first);
  });
  if (!others_wait || !network_.charge_limits()) return;
  for (const auto& [agent, robot] : robots_) {
    const RobotSeen seen = SeenOf(agent, robot);
    const bool may_leave = robot.is_heard && !seen.dock.empty() && seen.may_go_on &&
                           missions_.QueueOf(agent).empty() && missions_.HeldBy(agent).empty();
    if (!may_leave || IsLost(agent)) continue;
    const auto way =
        network_.WayOn(network_.StandOf(agent)->place, std::string(mission::kHomeWord));
    if (!way || way->empty()) continue;
    if (missions_.TakeFirst({.agent = agent,
                             .id = fmt::format("{}{:x}", kRoomPrefix, now_unix_ms),
                             .client = server_,
                             .orders = OrdersWithoutWay({.to = std::string(mission::kHomeWord)}),
                             .valid_for_s = kChargeWithin_s},
                            now, now_unix_ms)) {
      return;
    }
  }
}

}  // namespace trailcast::server
