#include "services/vda5050/gateway.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "services/base/unix_time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/draw.h"
#include "services/network/words.h"
#include "services/program/json.h"

namespace trailcast::vda5050 {
namespace {

using exchange::Topic;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr milliseconds kTakeWait{20};
constexpr milliseconds kAskAgain{500};
// A network that no server has told by then is judged without.
constexpr seconds kNetworkWithin{3};
constexpr seconds kNetworkEvery{5};  // while none is known
constexpr seconds kMissionsEvery{30};
constexpr std::size_t kMostLines = 500'000;

// Returns the only agent that the message is about, or nothing if all may have to hear it.
std::optional<AgentId> AgentOf(const exchange::Message& message) {
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) return status->agent;
  if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) return gone->agent;
  if (const auto* report = std::get_if<mission::Report>(&message)) return report->agent;
  if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) return answer->agent;
  return std::nullopt;
}

exchange::MissionRequest OpenMissions(const AgentId& self) {
  exchange::MissionRequest request{.client = self};
  request.query.page_size = exchange::kMaxMissionsPerReply;
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    if (!mission::HasEnded(static_cast<mission::State>(i))) request.query.states |= 1U << i;
  }
  return request;
}

}  // namespace

exchange::TopicUse GatewayTopics() {
  return {.write = {Topic::kNow, Topic::kMissions, Topic::kMissionRequests, Topic::kNetworkRequests,
                    Topic::kCatalogRequests},
          .read = {Topic::kNowAnswers, Topic::kMissionStates, Topic::kMissionReplies,
                   Topic::kNetworkReplies, Topic::kCatalogReplies},
          .overhear = {Topic::kAgents}};
}

Gateway::Gateway(AgentId self, std::unique_ptr<exchange::RouteExchange> exchange, Options options)
    : self_(std::move(self)), exchange_(std::move(exchange)), options_(std::move(options)) {}

Result<void> Gateway::Serve(const std::function<bool()>& stop) {
  Result<void> served;
  while (served && !stop()) served = Step(steady_clock::now());
  for (auto& [name, robot] : robots_) SayGoodbye(robot);
  return served;
}

Result<void> Gateway::Step(Time now) {
  for (const exchange::Message& message : exchange_->Take(kTakeWait)) Hear(message, now);
  for (auto& [name, robot] : robots_) {
    if (!robot.link && robot.vehicle.tells_battery()) {
      if (auto presented = Present(robot); !presented) return presented;
    }
    if (robot.link) TakeFromBroker(robot, now);
  }
  AskServers(now);
  for (auto& [name, robot] : robots_) {
    robot.vehicle.NoteCharging(charging_.WordsOf(name.value(), now));
    robot.vehicle.Tick(graph(), now);
    for (const exchange::Message& message : robot.vehicle.Due(now)) {
      const auto said = exchange_->Publish(message);  // what was not sent is said again
      if (!said && said.error().code != ErrorCode::kUnavailable) {
        return tl::unexpected(said.error());
      }
    }
    if (robot.link) TellBroker(robot, now);
  }
  DropGone(now);
  return {};
}

void Gateway::Hear(const exchange::Message& message, Time now) {
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) Meet(*status, now);
  if (const auto* reply = std::get_if<exchange::NetworkReply>(&message)) Hear(*reply, now);
  if (const auto* reply = std::get_if<exchange::CatalogReply>(&message)) Hear(*reply, now);
  if (missions_question_ && missions_question_->AnswerIn(message) != nullptr) {
    missions_question_.reset();
  }
  if (const auto agent = AgentOf(message)) {
    const auto known = robots_.find(*agent);
    if (known != robots_.end()) known->second.vehicle.Hear(message, now);
    return;
  }
  for (auto& [name, robot] : robots_) robot.vehicle.Hear(message, now);
}

void Gateway::Meet(const exchange::AgentStatus& status, Time now) {
  const auto known = robots_.find(status.agent);
  if (known != robots_.end()) {
    known->second.heard_at = now;
    return;
  }
  const bool begins = status.mode == exchange::AgentMode::kStarting;
  if (status.role != exchange::AgentRole::kFollower || begins) return;
  const auto leave_out = [&](const std::string& why) {
    if (left_out_.size() < kMostRobots && left_out_.insert(status.agent).second) {
      spdlog::warn("{} is not presented: {}", status.agent.value(), why);
    }
  };
  if (!status.battery_percent && !options_.battery) {
    return leave_out(
        "it tells no battery, which the standard's state must have and the gateway does not make "
        "up: give its agent --battery-topic, or the gateway --battery-if-untold PERCENT (100 for "
        "a robot that is powered for good)");
  }
  if (robots_.size() >= kMostRobots) {
    return leave_out(fmt::format("{} robots are already", kMostRobots));
  }
  const Identity identity{options_.version, options_.manufacturer, status.agent.value()};
  robots_.emplace(status.agent,
                  Robot{.vehicle = Vehicle(identity, self_, options_.battery), .heard_at = now});
}

Result<void> Gateway::Present(Robot& robot) {
  const Identity& identity = robot.vehicle.identity();
  auto link = BrokerLink::Open(
      options_.broker, fmt::format("trailcast-{}-{}", identity.manufacturer, identity.serial),
      {.topic = TopicOf(identity, "connection"),
       .text = ConnectionText(identity, Connection::kBroken, 0, NowUnixMs()),
       .quality = 1,
       .retained = true},
      {TopicOf(identity, "order"), TopicOf(identity, "instantActions")});
  if (!link) return tl::unexpected(link.error());
  robot.link = *std::move(link);
  spdlog::info("{} is presented as {}", identity.serial, TopicOf(identity, "#"));
  return {};
}

// Instant actions, which may stop a robot, come before orders.
void Gateway::TakeFromBroker(Robot& robot, Time now) {
  const Identity& identity = robot.vehicle.identity();
  const std::string order_topic = TopicOf(identity, "order");
  std::vector<BrokerLink::Incoming> orders;
  for (BrokerLink::Incoming& each : robot.link->Take()) {
    if (each.bytes > kMostBytes) {
      robot.vehicle.Refuse(
          TooLong(each.topic == order_topic ? "order" : "instantActions", each.bytes));
    } else if (each.topic == order_topic) {
      orders.push_back(std::move(each));
    } else {
      robot.vehicle.TakeInstantActions(each.text, now);
    }
  }
  for (BrokerLink::Incoming& each : orders) {
    if (waiting_.size() >= kMostOrdersWaiting) {
      robot.vehicle.Refuse({.type = "INSUFFICIENT_MEMORY",
                            .level = Level::kUrgent,
                            .description = "too many orders have come at once"});
      continue;
    }
    waiting_.push_back({AgentId(identity.serial), std::move(each.text)});
  }
}

void Gateway::AskServers(Time now) {
  if (now >= missions_at_) {
    missions_at_ = now + kMissionsEvery;
    missions_question_.emplace(OpenMissions(self_));
  }
  if (missions_question_) missions_question_->Ask(*exchange_, now);
  // If it cannot be sent, the next one is.
  if (const auto question = charging_.Due(now)) (void)exchange_->Publish(*question);

  if (network_question_ && now - network_question_->began > kNetworkWithin) {
    network_question_.reset();
    JudgeOrders(now);
  }
  const bool is_due = !waiting_.empty() || (!graph_ && now >= network_at_);
  if (!network_question_ && is_due) {
    network_at_ = now + kNetworkEvery;
    network_question_.emplace();
    network_question_->request = {.client = self_, .request = fleet::DrawNumber()};
    network_question_->began = now;
    network_question_->ask_at = now;
    for (WaitingOrder& order : waiting_) order.asked = true;
  }
  if (network_question_ && now >= network_question_->ask_at) {
    network_question_->ask_at = now + kAskAgain;
    const auto& [request, routes, lines, has_network, began, ask_at] = *network_question_;
    const auto asked =
        exchange_->Publish(has_network ? exchange::Message(routes) : exchange::Message(request));
    if (!asked && asked.error().code != ErrorCode::kUnavailable) {
      spdlog::error("the network of routes cannot be asked for: {}", asked.error().message);
    }
  }
}

void Gateway::Hear(const exchange::NetworkReply& reply, Time now) {
  charging_.Hear(reply, now);
  if (!network_question_ || network_question_->has_network || reply.client != self_ ||
      reply.request != network_question_->request.request) {
    return;
  }
  if (!reply.error.empty()) {
    return HasNetwork(
        Fail(ErrorCode::kUnavailable, "server '{}': {}", reply.server.value(), reply.error), now);
  }
  NetworkQuestion& question = *network_question_;
  question.lines.insert(question.lines.end(), reply.lines.begin(), reply.lines.end());
  question.ask_at = now;
  if (reply.next > question.request.first && question.lines.size() < kMostLines) {
    question.request.first = reply.next;
    question.request.request = fleet::DrawNumber();
    return;
  }
  question.has_network = true;
  question.routes = {.client = self_, .request = fleet::DrawNumber()};
  question.routes.query.standing = route::Standing::kActive;
  question.routes.query.page_size = exchange::kMaxRoutesPerReply;
}

void Gateway::Hear(const exchange::CatalogReply& reply, Time now) {
  if (!network_question_ || !network_question_->has_network || reply.client != self_ ||
      reply.request != network_question_->routes.request) {
    return;
  }
  if (!reply.error.empty()) {
    return HasNetwork(
        Fail(ErrorCode::kUnavailable, "server '{}': {}", reply.server.value(), reply.error), now);
  }
  NetworkQuestion& question = *network_question_;
  for (const route::RouteInfo& info : reply.page.routes) {
    if (info.state != route::RouteState::kComplete || info.length_m <= 0.0) continue;
    question.lines.push_back(
        network::ToText(network::Route{.name = info.name, .length_m = info.length_m}));
  }
  if (!reply.page.next.empty() && question.lines.size() < kMostLines) {
    question.routes.query.cursor = reply.page.next;
    question.routes.request = fleet::DrawNumber();
    question.ask_at = now;
    return;
  }
  HasNetwork(Graph::Read(question.lines), now);
}

void Gateway::HasNetwork(Result<Graph> graph, Time now) {
  if (graph) {
    graph_ = *std::move(graph);
  } else {
    spdlog::warn("the network of routes: {}", graph.error().message);
  }
  network_question_.reset();
  JudgeOrders(now);
}

void Gateway::JudgeOrders(Time now) {
  while (!waiting_.empty() && waiting_.front().asked) {
    const auto known = robots_.find(waiting_.front().robot);
    if (known != robots_.end()) {
      known->second.vehicle.TakeOrder(waiting_.front().text, graph(), now);
    }
    waiting_.pop_front();
  }
}

void Gateway::TellConnection(Robot& robot, Connection connection) {
  robot.told = connection;
  robot.link->Publish({.topic = TopicOf(robot.vehicle.identity(), "connection"),
                       .text = ConnectionText(robot.vehicle.identity(), connection,
                                              ++robot.connection_headers, NowUnixMs()),
                       .quality = 1,
                       .retained = true});
}

void Gateway::TellBroker(Robot& robot, Time now) {
  if (!robot.link->connected()) return;
  Vehicle& vehicle = robot.vehicle;
  const Identity& identity = vehicle.identity();
  const std::uint64_t connections = robot.link->connections();
  const bool is_new = std::exchange(robot.connections, connections) != connections;
  const Connection connection = vehicle.ConnectionAt(now);
  if (is_new || robot.told != connection) TellConnection(robot, connection);
  if (vehicle.TakeFactsheetRequest() || is_new) {
    robot.link->Publish(
        {.topic = TopicOf(identity, "factsheet"),
         .text = FactsheetText(identity, options_.body, ++robot.factsheet_headers, NowUnixMs()),
         // A fleet manager that comes later reads it, too.
         .retained = true});
  }
  const auto since = now - robot.told_at;
  std::string events = program::OneLine(vehicle.Events(now));
  const bool has_changed = events != robot.told_events && since >= kStateAtMostEvery;
  const bool is_due = connection == Connection::kOnline && since >= kStateEvery;
  if (!vehicle.TakeStateRequest() && !is_new && !has_changed && !is_due) return;
  program::Json state = Header(identity, ++robot.state_headers, NowUnixMs());
  state.update(vehicle.State(now));
  robot.link->Publish({.topic = TopicOf(identity, "state"), .text = program::OneLine(state)});
  robot.told_events = std::move(events);
  robot.told_at = now;
}

void Gateway::SayGoodbye(Robot& robot) {
  if (!robot.link) return;
  robot.link->Close({.topic = TopicOf(robot.vehicle.identity(), "connection"),
                     .text = ConnectionText(robot.vehicle.identity(), Connection::kOffline,
                                            ++robot.connection_headers, NowUnixMs()),
                     .quality = 1,
                     .retained = true});
}

void Gateway::DropGone(Time now) {
  for (auto each = robots_.begin(); each != robots_.end();) {
    if (now - each->second.heard_at < kGoneAfter) {
      ++each;
      continue;
    }
    SayGoodbye(each->second);
    each = robots_.erase(each);
  }
}

}  // namespace trailcast::vda5050
