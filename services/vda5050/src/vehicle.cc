#include "services/vda5050/vehicle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "services/exchange/bounds.h"
#include "services/fleet/draw.h"
#include "services/mission/orders.h"
#include "services/route/route_ref.h"

namespace trailcast::vda5050 {
namespace {

using exchange::AgentMode;
using exchange::AgentStatus;
using exchange::NowOrder;
using mission::State;
using std::chrono::duration_cast;
using std::chrono::milliseconds;

// A server makes orders longer where it leads the robot another way.
constexpr std::size_t kMostOrdersBytes = exchange::kMaxLineBytes / 2;
constexpr double kLeastStretch_m = 0.02;
// A robot's place may be off the section that it is on by this.
constexpr double kOffStretch_m = 0.5;
constexpr double kReached_m = 0.05;
constexpr std::size_t kMostOwn = 32;
constexpr std::size_t kMostCommands = 4;
constexpr milliseconds kTellAgain{100};
constexpr milliseconds kTellOnAgain{500};  // what was not answered in time

double ToCentimetres(double metres) { return std::round(100.0 * metres) / 100.0; }

// Returns them with the turns before them; `of` gets the task of each section.
std::vector<mission::Task> TasksAlong(const std::vector<network::Stretch>& stretches,
                                      std::vector<std::uint32_t>& of) {
  std::vector<mission::Task> tasks;
  of.clear();
  for (const network::Stretch& stretch : stretches) {
    if (stretch.turn_rad != 0.0) {
      tasks.push_back({.kind = mission::Task::Kind::kTurn, .turn_rad = stretch.turn_rad});
    }
    of.push_back(static_cast<std::uint32_t>(tasks.size()));
    tasks.push_back(
        {.route = route::ParseRouteRef(stretch.route).value_or(route::RouteRef{stretch.route}),
         .from_m = ToCentimetres(stretch.from_m),
         .to_m = ToCentimetres(stretch.to_m),
         .backwards = stretch.backwards(),
         .speed_factor = stretch.speed});
  }
  return tasks;
}

void Append(std::vector<network::Stretch>& way, const network::Way& more) {
  for (const network::Stretch& stretch : more.stretches) {
    if (stretch.length_m() < kLeastStretch_m) continue;
    const bool goes_on = !way.empty() && network::GoesOn(way.back(), stretch) &&
                         way.back().speed == stretch.speed && stretch.turn_rad == 0.0;
    if (goes_on) {
      way.back().to_m = stretch.to_m;
    } else {
      way.push_back(stretch);
    }
  }
}

Fault OrderFault(const char* type, const Order& order, std::string description,
                 std::string hint = {}) {
  return {.type = type,
          .description = std::move(description),
          .hint = std::move(hint),
          .references = {{"orderId", order.id}, {"orderUpdateId", fmt::to_string(order.update)}}};
}

}  // namespace

Vehicle::Vehicle(Identity identity, AgentId client, std::optional<std::uint8_t> battery)
    : identity_(std::move(identity)), client_(std::move(client)), battery_(battery) {}

void Vehicle::Hear(const exchange::Message& message, Time now) {
  if (const auto* status = std::get_if<AgentStatus>(&message)) {
    if (status->agent == robot()) On(*status, now);
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    if (gone->agent == robot() && gone->instance == status_.instance) gone_ = true;
  } else if (const auto* report = std::get_if<mission::Report>(&message)) {
    if (report->agent == robot()) On(*report, now);
  } else if (const auto* reply = std::get_if<exchange::MissionReply>(&message)) {
    On(*reply, now);
  }
  if (leg_) (void)leg_->sending.Hear(message);
  for (Command& command : commands_) command.telling.Hear(message);
}

void Vehicle::On(const AgentStatus& status, Time now) {
  status_ = status;
  heard_ = true;
  gone_ = false;
  heard_at_ = now;
  if (!status.place) return;
  stood_ = network::Place{status.route, status.place->along_m};
  const bool on_mission = RobotHasLeg() || !foreign_.empty();
  if (status.mode == AgentMode::kReplaying && on_mission) lost_.clear();
}

// The servers' word on which missions have not ended: that one has may not have been heard here.
void Vehicle::On(const exchange::MissionReply& reply, Time now) {
  if (reply.client != client_ || reply.next != 0 || !reply.error.empty()) return;
  const bool goes_on =
      std::any_of(reply.missions.begin(), reply.missions.end(), [&](const mission::Record& each) {
        return each.mission.agent == robot() && each.mission.id == foreign_;
      });
  if (!goes_on) foreign_.clear();
  for (const mission::Record& record : reply.missions) {
    if (record.mission.agent == robot()) On(record.last, now);
  }
}

bool Vehicle::IsOwn(const std::string& mission) const {
  return std::find(own_.begin(), own_.end(), mission) != own_.end();
}

void Vehicle::On(const mission::Report& report, Time now) {
  if (report.change == 0) return;  // a server's word: the robot has not taken it
  const bool ended = mission::HasEnded(report.state);
  if (!IsOwn(report.mission)) {
    if (!ended) {
      foreign_ = report.mission;
    } else if (foreign_ == report.mission) {
      foreign_.clear();
    }
    return;
  }
  if (!ended) foreign_.clear();  // a robot does one mission at a time
  // It has reached the robot after the order was cancelled.
  const bool is_stale = !leg_ || leg_->sending.mission().id != report.mission;
  const bool is_told = std::any_of(commands_.begin(), commands_.end(), [](const Command& each) {
    return each.order == NowOrder::kCancel;
  });
  if (is_stale && !ended && !is_told) Tell("", NowOrder::kCancel, now);
}

Vehicle::Mode Vehicle::ModeNow() const {
  if (status_.mode == AgentMode::kTeaching || status_.role == exchange::AgentRole::kScout) {
    return Mode::kTeachIn;
  }
  if (status_.mode == AgentMode::kStarting && !IsActive()) return Mode::kStartup;
  if (status_.mode == AgentMode::kFault) return IsActive() ? Mode::kAutomatic : Mode::kService;
  if (!foreign_.empty() || (!status_.on_duty && !IsActive())) return Mode::kManual;
  return Mode::kAutomatic;
}

Connection Vehicle::ConnectionAt(Time now) const {
  if (!heard_) return Connection::kOffline;
  if (status_.mode == AgentMode::kStopped) return Connection::kOffline;
  if (gone_ || now - heard_at_ > kSilentAfter) return Connection::kBroken;
  return Connection::kOnline;
}

bool Vehicle::Drives() const { return std::abs(status_.speed_mps) > 0.0; }

bool Vehicle::IsPaused() const {
  if (status_.hold != exchange::AgentHold::kNone) return true;
  return leg_ && leg_->sending.last() && leg_->sending.last()->state == State::kPaused;
}

std::size_t Vehicle::LastReleased() const {
  std::size_t last = 0;
  const auto& nodes = held_->order.nodes;
  while (last + 1 < nodes.size() && nodes[last + 1].released) ++last;
  return last;
}

// --- Orders

void Vehicle::TakeOrder(std::string_view payload, const Graph* graph, Time now) {
  state_asked_ = true;
  auto order = ParseOrder(identity_, payload);
  if (!order) {
    rejected_ = order.error();
    return;
  }
  const bool is_update = held_ && held_->order.id == order->id;
  if (is_update && order->update == held_->order.update && order->content == held_->order.content) {
    return;  // said again
  }
  // A robot on its way may be out of reach for a while.
  const bool is_there = (is_update && IsActive()) || ConnectionAt(now) == Connection::kOnline;
  std::optional<Fault> refused;
  if (!is_there || ModeNow() != Mode::kAutomatic) {
    refused = OrderFault(
        "MOBILE_ROBOT_NOT_AVAILABLE", *order,
        !is_there ? identity_.serial + " is not heard"
        : !foreign_.empty()
            ? fmt::format("{} does mission {} of another sender", identity_.serial, foreign_)
            : fmt::format("{} takes no orders now: {}", identity_.serial,
                          status_.on_duty ? status_.detail : "it is not on duty"),
        "Its agent has to run as 'trailcast-agent serve', and to be free.");
  } else {
    refused = is_update ? TakeUpdate(*std::move(order), graph) : TakeNew(*std::move(order), graph);
  }
  if (refused) rejected_ = *std::move(refused);
}

std::optional<Fault> Vehicle::CheckNodes(const Order& order, const Graph* graph) const {
  if (graph == nullptr) {
    return OrderFault("NO_ROUTE_TO_TARGET", order,
                      "no route server has told the network of routes yet",
                      "Is trailcast-server running, with the same --domain and --dds-tag?");
  }
  std::optional<Graph::Node> before;
  for (const Step& step : order.nodes) {
    auto node = graph->Find(step.id);
    if (!node) return OrderFault("NO_ROUTE_TO_TARGET", order, node.error().message);
    if (before) {
      const auto way = graph->WayBetween(before->place, node->place);
      if (!way) return OrderFault("NO_ROUTE_TO_TARGET", order, way.error().message);
    }
    before = *std::move(node);
  }
  return std::nullopt;
}

std::optional<Fault> Vehicle::TakeNew(Order order, const Graph* graph) {
  if (IsActive()) {
    return OrderFault("OTHER_ORDER_ACTIVE", order,
                      fmt::format("order '{}' is not done yet", held_->order.id),
                      "Wait for it, or send cancelOrder.");
  }
  if (order.update != 0 && identity_.version == Version::k3_0) {
    return OrderFault(
        "VALIDATION_FAILURE", order,
        "a new order begins with orderUpdateId 0: what came before is not known here");
  }
  if (auto fault = CheckNodes(order, graph)) return fault;
  const auto first = graph->Find(order.nodes.front().id);
  if (stood_ && !graph->IsOn(*stood_, first->place)) {
    return OrderFault("START_NODE_OUT_OF_RANGE", order,
                      fmt::format("{} stands {:.1f} m along {}, not on node '{}'", identity_.serial,
                                  stood_->along_m, stood_->route, order.nodes.front().id),
                      fmt::format("Begin with a node within {:g} m of it; it has said so of node "
                                  "'{}'.",
                                  Graph::kOnNode_m,
                                  graph->NodeAt(*stood_).value_or(
                                      fmt::format("{}:{:.2f}", stood_->route, stood_->along_m))));
  }
  held_ = Held{.order = std::move(order)};
  NoteReached(0);
  // 2.1 tells instant actions among an order's.
  if (identity_.version == Version::k2_1) ClearActions();
  unreachable_.reset();
  disobeyed_.reset();
  Accepted();
  return std::nullopt;
}

std::optional<Fault> Vehicle::TakeUpdate(Order order, const Graph* graph) {
  Order& held = held_->order;
  if (order.update == held.update) {
    return OrderFault("SAME_ORDER_UPDATE_ID", order, "another content has come with this number");
  }
  if (order.update < held.update) {
    return OrderFault("OUTDATED_ORDER_UPDATE", order,
                      fmt::format("update {} has been taken already", held.update));
  }
  if (held_->cancelled) {
    return OrderFault("ORDER_UPDATE_FOLLOWING_CANCEL", order, "this order was cancelled",
                      "Send a new order.");
  }
  const std::size_t last = LastReleased();
  if (order.nodes.front().id != held.nodes[last].id ||
      order.nodes.front().sequence != held.nodes[last].sequence) {
    return OrderFault("VALIDATION_FAILURE", order,
                      fmt::format("it does not begin with the last released node, '{}' of "
                                  "sequenceId {}",
                                  held.nodes[last].id, held.nodes[last].sequence));
  }
  if (auto fault = CheckNodes(order, graph)) return fault;
  held.nodes.resize(last + 1);
  held.edges.resize(last);
  if (held.nodes.size() + order.nodes.size() > 2 * kMostNodes) {
    // The nodes behind the robot are no longer needed.
    held.nodes.erase(held.nodes.begin(),
                     held.nodes.begin() + static_cast<std::ptrdiff_t>(held_->at));
    held.edges.erase(held.edges.begin(),
                     held.edges.begin() + static_cast<std::ptrdiff_t>(held_->at));
    if (leg_) {
      for (Leg::Mark& mark : leg_->marks) mark.node -= std::min(mark.node, held_->at);
    }
    held_->at = 0;
  }
  held.nodes.insert(held.nodes.end(), order.nodes.begin() + 1, order.nodes.end());
  held.edges.insert(held.edges.end(), order.edges.begin(), order.edges.end());
  held.update = order.update;
  held.content = std::move(order.content);
  held_->active = true;
  if (held_->at + 1 == held.nodes.size()) held_->active = false;
  Accepted();
  return std::nullopt;
}

void Vehicle::Accepted() {
  rejected_.reset();
  no_cancel_.reset();
}

void Vehicle::NoteReached(std::size_t node) {
  held_->at = node;
  last_node_ = held_->order.nodes[node].id;
  held_->active = node + 1 < held_->order.nodes.size();
}

// --- Missions

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
  std::vector<network::Stretch> way;
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
             .stretches = std::move(way),
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
  while (last.way <= 1 && on + 1 < leg_->stretches.size() && leg_->tasks[on] < last.task) ++on;
  const auto holds = [&](const network::Stretch& stretch) {
    const double driven_m = stretch.DrivenAt(status_.place->along_m);
    return stretch.route == status_.route && driven_m >= -kOffStretch_m &&
           driven_m <= stretch.length_m() + kOffStretch_m;
  };
  while (on < leg_->stretches.size() && !holds(leg_->stretches[on])) ++on;
  if (on == leg_->stretches.size()) return;
  leg_->on = on;
  const network::Stretch& stretch = leg_->stretches[on];
  const auto before = std::span(leg_->stretches).first(on);
  leg_->driven_m = network::LengthOf(before) +
                   std::clamp(stretch.DrivenAt(status_.place->along_m), 0.0, stretch.length_m());
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
  if (last.detail.starts_with("LOST")) lost_ = last.detail;
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

// --- Instant actions

void Vehicle::TakeInstantActions(std::string_view payload, Time now) {
  state_asked_ = true;
  const auto actions = ParseInstantActions(identity_, payload);
  if (!actions) {
    rejected_action_ = actions.error();
    return;
  }
  for (const Action& action : *actions) {
    const bool is_known = std::any_of(actions_.begin(), actions_.end(), [&](const auto& each) {
      return each.action.id == action.id;
    });
    if (is_known) continue;  // said again
    if (actions_.size() >= kMostActionStates) {
      const auto ended = std::find_if(actions_.begin(), actions_.end(), [](const auto& each) {
        return each.status == "FINISHED" || each.status == "FAILED";
      });
      actions_.erase(ended == actions_.end() ? actions_.begin() : ended);
    }
    actions_.push_back({action, "RUNNING", ""});
    Begin(action, now);
  }
}

void Vehicle::Begin(const Action& action, Time now) {
  const bool is_new = identity_.version == Version::k3_0;
  if (action.type == "cancelOrder") return BeginCancel(action, now);
  if (action.type == "startPause") return Tell(action.id, NowOrder::kPause, now);
  if (action.type == "stopPause") {
    for (Command& command : commands_) {
      if (command.order != NowOrder::kPause) continue;
      Conclude(command.action, "FAILED", "stopPause came before the robot had answered");
    }
    std::erase_if(commands_, [](const Command& each) { return each.order == NowOrder::kPause; });
    return Tell(action.id, NowOrder::kResume, now);
  }
  if (action.type == "stateRequest") return Conclude(action.id, "FINISHED", "");
  if (action.type == "factsheetRequest") {
    factsheet_asked_ = true;
    return Conclude(action.id, "FINISHED", "");
  }
  if (action.type == "clearInstantActions" && is_new) {
    ClearActions();
    return Conclude(action.id, "FINISHED", "");
  }
  rejected_action_ = Fault{.type = "INVALID_INSTANT_ACTION",
                           .description = fmt::format("'{}' is no instant action of this robot: "
                                                      "its factsheet lists them",
                                                      action.type),
                           .references = {{"actionId", action.id}}};
  Conclude(action.id, "FAILED", "this robot has no such action");
}

void Vehicle::BeginCancel(const Action& action, Time now) {
  const bool is_meant = IsActive() && (action.order.empty() || action.order == held_->order.id);
  if (!is_meant) {
    const std::string why =
        IsActive() ? fmt::format("order '{}' is active, not '{}'", held_->order.id, action.order)
                   : "no order is active";
    no_cancel_ = Fault{
        .type = "NO_ORDER_TO_CANCEL", .description = why, .references = {{"actionId", action.id}}};
    return Conclude(action.id, "FAILED", why);
  }
  if (!leg_) {  // nothing of it is on its way
    EndOrder();
    return Conclude(action.id, "FINISHED", "");
  }
  leg_->withdrawn = true;
  Tell(action.id, NowOrder::kCancel, now);
}

void Vehicle::Tell(const std::string& action, NowOrder order, Time now) {
  if (commands_.size() >= kMostCommands) {
    Conclude(commands_.front().action, "FAILED", "too many commands have come after it");
    commands_.erase(commands_.begin());
  }
  commands_.push_back(
      {.action = action,
       .order = order,
       .telling = fleet::Telling(client_, order,
                                 {{.whom = exchange::NowWhom::kRobot, .name = identity_.serial}},
                                 "by a fleet manager, over VDA 5050"),
       .began = now,
       .say_at = now});
}

void Vehicle::Conclude(const std::string& action, const char* status, const std::string& result) {
  for (ActionState& each : actions_) {
    if (action.empty() || each.action.id != action || each.status != "RUNNING") continue;
    each.status = status;
    each.result = result;
    if (each.status == "FINISHED") rejected_action_.reset();
  }
}

void Vehicle::ClearActions() {
  std::erase_if(actions_, [](const ActionState& each) {
    return each.status == "FINISHED" || each.status == "FAILED";
  });
}

void Vehicle::SeeTo(Time now) {
  std::erase_if(commands_, [&](Command& command) { return SeeTo(command, now); });
}

// Returns whether it is over.
bool Vehicle::SeeTo(Command& command, Time now) {
  const auto since = duration_cast<milliseconds>(now - command.began);
  const std::vector<fleet::RobotsWord> words = command.telling.Words();
  const fleet::RobotsWord& word = words.front();
  const bool cancels = command.order == NowOrder::kCancel;
  if (command.telling.AllAnswered(since)) {
    // A robot says that it has no mission if it has not taken the one that is meant, or has ended
    // it.
    if (word.refused && !(cancels && !RobotHasLeg())) {
      NotObeyed(command, identity_.serial + " does not obey: " + word.detail);
      return true;
    }
    if (command.order != NowOrder::kResume && Drives()) return false;  // until it stands
    Obeyed(command, word.refused ? "" : word.detail);
    return true;
  }
  if (since < kAnswerWithin || command.failed) return false;
  NotObeyed(command, fmt::format("{} did not answer within {} s and may be moving",
                                 identity_.serial, kAnswerWithin.count() / 1000));
  // A robot that is told late to go on may surprise somebody.
  return command.order == NowOrder::kResume;
}

void Vehicle::Obeyed(const Command& command, const std::string& detail) {
  disobeyed_.reset();
  if (command.order == NowOrder::kCancel && IsActive() && leg_ && leg_->withdrawn) EndOrder();
  if (command.order == NowOrder::kCancel && IsActive() && !leg_) EndOrder();
  Conclude(command.action, "FINISHED", detail);
}

void Vehicle::NotObeyed(Command& command, const std::string& why) {
  command.failed = true;
  disobeyed_ = Fault{.type = "ROBOT_DID_NOT_OBEY",
                     .level = Level::kCritical,
                     .description = why,
                     .hint = command.order == NowOrder::kResume
                                 ? "Look why it stands, and send stopPause again."
                                 : "Look at the robot: its red button stops it."};
  if (!command.action.empty()) disobeyed_->references = {{"actionId", command.action}};
  Conclude(command.action, "FAILED", why);
  const bool answered = command.telling.Words().front().answered;
  if (answered && command.order == NowOrder::kCancel && leg_) leg_->withdrawn = false;
}

std::vector<exchange::Message> Vehicle::Due(Time now) {
  std::vector<exchange::Message> due;
  for (Command& command : commands_) {
    if (now < command.say_at) continue;
    command.say_at = now + (command.failed ? kTellOnAgain : kTellAgain);
    for (const exchange::NowCommand& each : command.telling.commands()) due.emplace_back(each);
  }
  if (leg_ && !leg_->withdrawn && now >= leg_->say_at) {
    leg_->say_at = now + leg_->sending.SayAgain();
    due.emplace_back(leg_->sending.mission());
  }
  return due;
}

}  // namespace trailcast::vda5050
