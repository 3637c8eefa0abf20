// This part of Vehicle sends the robot along an order's released nodes, one mission after the
// other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "services/exchange/bounds.h"
#include "services/fleet/draw.h"
#include "services/mission/orders.h"
#include "services/route/route_ref.h"
#include "services/vda5050/vehicle.h"

namespace trailcast::vda5050 {
namespace {

using exchange::NowOrder;
using mission::State;

// A server makes orders longer where it leads the robot another way.
constexpr std::size_t kMostOrdersBytes = exchange::kMaxLineBytes / 2;
constexpr double kLeastSection_m = 0.02;
// A robot's place may be off the section that it is on by this.
constexpr double kOffSection_m = 0.5;
constexpr double kReached_m = 0.05;
constexpr std::size_t kMostOwn = 32;

double ToCentimetres(double metres) { return std::round(100.0 * metres) / 100.0; }

// Returns them with the turns before them; `of` gets the task of each section.
std::vector<mission::Task> TasksAlong(const std::vector<network::Section>& sections,
                                      std::vector<std::uint32_t>& of) {
  std::vector<mission::Task> tasks;
  of.clear();
  for (const network::Section& section : sections) {
    if (section.turn_rad != 0.0) {
      tasks.push_back({.kind = mission::Task::Kind::kTurn, .turn_rad = section.turn_rad});
    }
    of.push_back(static_cast<std::uint32_t>(tasks.size()));
    tasks.push_back(
        {.route = route::ParseRouteRef(section.route).value_or(route::RouteRef{section.route}),
         .from_m = ToCentimetres(section.from_m),
         .to_m = ToCentimetres(section.to_m),
         .backwards = section.backwards(),
         .speed_factor = section.speed});
  }
  return tasks;
}

void Append(std::vector<network::Section>& way, const network::Way& more) {
  for (const network::Section& section : more.sections) {
    if (section.length_m() < kLeastSection_m) continue;
    const bool goes_on = !way.empty() && network::GoesOn(way.back(), section) &&
                         way.back().speed == section.speed && section.turn_rad == 0.0;
    if (goes_on) {
      way.back().to_m = section.to_m;
    } else {
      way.push_back(section);
    }
  }
}

}  // namespace

void Vehicle::Tick(const Graph* graph, Time now) {
  if (rejected_ && rejected_->type == "MOBILE_ROBOT_NOT_AVAILABLE" &&
      ModeNow() == Mode::kAutomatic && ConnectionAt(now) == Connection::kOnline) {
    rejected_.reset();
  }
  if (leg_ && leg_->sending.last()) {
    Progress();
    const mission::Report last = *leg_->sending.last();
    if (mission::HasEnded(last.state)) EndLeg(last);
  }
  SeeTo(now);
  const Mode mode = ModeNow();
  if (mode == Mode::kTeachIn || mode == Mode::kManual) {
    if (IsActive() && !leg_) EndOrder();
    if (mode == Mode::kTeachIn || !foreign_.empty()) last_node_.clear();
  }
  if (!IsActive() && last_node_.empty() && mode == Mode::kAutomatic && graph != nullptr && stood_) {
    last_node_ = graph->NodeAt(*stood_).value_or("");
  }
  const bool stops = std::any_of(commands_.begin(), commands_.end(), [](const Command& each) {
    return each.order != NowOrder::kResume;
  });
  const bool may_go = IsActive() && !leg_ && !unreachable_ && !stops && graph != nullptr &&
                      mode == Mode::kAutomatic && ConnectionAt(now) == Connection::kOnline;
  if (may_go && held_->at < LastReleased()) BeginLeg(*graph, now);
}

void Vehicle::BeginLeg(const Graph& graph, Time now) {
  const auto& nodes = held_->order.nodes;
  const auto fail = [&](const std::string& node, const std::string& why) {
    unreachable_ = Fault{.type = "NODE_UNREACHABLE",
                         .level = Level::kCritical,
                         .description = why,
                         .hint = "Send cancelOrder, and a new order from where the robot stands.",
                         .references = {{"nodeId", node}, {"orderId", held_->order.id}}};
  };
  auto at = graph.Find(nodes[held_->at].id).map([](const Graph::Node& node) { return node.place; });
  if (!at) return fail(nodes[held_->at].id, at.error().message);
  if (stood_ && graph.IsOn(*stood_, *at)) at = *stood_;
  std::vector<network::Section> way;
  std::vector<std::uint32_t> of;
  std::vector<Leg::Mark> marks;
  std::string orders;
  for (std::size_t i = held_->at + 1; i <= LastReleased(); ++i) {
    const auto node = graph.Find(nodes[i].id);
    if (!node) return fail(nodes[i].id, node.error().message);
    auto longer = way;
    // A robot that has stopped a little beyond a node has passed it.
    const auto more = graph.WayBetween(*at, node->place);
    const bool is_there = way.empty() && graph.IsOn(*at, node->place);
    if (!more && !is_there) return fail(nodes[i].id, more.error().message);
    if (more) Append(longer, *more);
    const auto tasks = TasksAlong(longer, of);
    const std::string text = mission::ToText(mission::Going{.to = node->goal}, tasks);
    if (text.size() > kMostOrdersBytes) {
      if (!marks.empty()) break;
      return fail(nodes[i].id, "the way to it has more parts than one mission holds");
    }
    way = std::move(longer);
    orders = text;
    marks.push_back({i, network::LengthOf(way)});
    if (more) at = node->place;
  }
  if (way.empty()) return NoteReached(marks.back().node);  // it is there already
  (void)TasksAlong(way, of);
  const std::string id = fleet::DrawMissionId();
  own_.push_back(id);
  if (own_.size() > kMostOwn) own_.pop_front();
  leg_ = Leg{.sending = fleet::Sending({.agent = robot(),
                                        .id = id,
                                        .client = client_,
                                        .orders = orders,
                                        .valid_for_s = kValidFor_s}),
             .began = now,
             .say_at = now,
             .sections = std::move(way),
             .tasks = std::move(of),
             .marks = std::move(marks)};
}

// Whether the robot itself has said that it does the leg's mission.
bool Vehicle::RobotHasLeg() const {
  if (!leg_ || !leg_->sending.last()) return false;
  const mission::Report& last = *leg_->sending.last();
  return last.change > 0 && !mission::HasEnded(last.state);
}

// The last node of a leg is reached once the robot says that it has arrived.
void Vehicle::Progress() {
  const mission::Report& last = *leg_->sending.last();
  const bool drives = last.state == State::kUnderWay || last.state == State::kPaused;
  if (!drives || !status_.place) return;
  std::size_t on = leg_->on;
  while (last.way <= 1 && on + 1 < leg_->sections.size() && leg_->tasks[on] < last.task) ++on;
  const auto holds = [&](const network::Section& section) {
    const double driven_m = section.DrivenAt(status_.place->along_m);
    return section.route == status_.route && driven_m >= -kOffSection_m &&
           driven_m <= section.length_m() + kOffSection_m;
  };
  while (on < leg_->sections.size() && !holds(leg_->sections[on])) ++on;
  if (on == leg_->sections.size()) return;
  leg_->on = on;
  const network::Section& section = leg_->sections[on];
  const auto before = std::span(leg_->sections).first(on);
  leg_->driven_m = network::LengthOf(before) +
                   std::clamp(section.DrivenAt(status_.place->along_m), 0.0, section.length_m());
  while (leg_->marks.size() > 1 && leg_->driven_m >= leg_->marks.front().driven_m - kReached_m) {
    leg_->from_m = leg_->marks.front().driven_m;
    NoteReached(leg_->marks.front().node);
    leg_->marks.erase(leg_->marks.begin());
  }
}

void Vehicle::EndLeg(const mission::Report& last) {
  const std::size_t to = leg_->marks.back().node;
  const bool withdrawn = leg_->withdrawn;
  leg_.reset();
  if (last.state == State::kArrived) {
    lost_.clear();
    return NoteReached(to);
  }
  if (last.waits_for == mission::WaitsFor::kPlace) {
    lost_ = last.detail.empty() ? "it is lost" : last.detail;
  }
  if (withdrawn && last.state == State::kCancelled) return;
  unreachable_ =
      Fault{.type = "NODE_UNREACHABLE",
            .level = Level::kCritical,
            .description = fmt::format("its mission there is {}{}{}", mission::ToString(last.state),
                                       last.detail.empty() ? "" : ": ", last.detail),
            .hint = "Send cancelOrder, and a new order from where the robot stands.",
            .references = {{"nodeId", held_->order.nodes[to].id}, {"orderId", held_->order.id}}};
}

// The standard keeps its ids, and empties its nodes and edges.
void Vehicle::EndOrder() {
  leg_.reset();
  unreachable_.reset();
  held_->active = false;
  held_->cancelled = true;
}

}  // namespace trailcast::vda5050
