#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/exchange/route_exchange.h"
#include "services/fleet/mission_question.h"
#include "services/vda5050/broker_link.h"
#include "services/vda5050/charging_watch.h"
#include "services/vda5050/graph.h"
#include "services/vda5050/protocol.h"
#include "services/vda5050/vehicle.h"

namespace trailcast::vda5050 {

// Returns the topics that the gateway reads and writes in the fleet.
[[nodiscard]] exchange::TopicUse GatewayTopics();

// Stands between a fleet and an MQTT broker: each follower that is heard is a vehicle there, with a
// client of its own.
class Gateway {
 public:
  struct Options {
    Version version = Version::k3_0;
    std::string manufacturer = "trailcast";
    BrokerOptions broker{};
    std::optional<std::uint8_t> battery{};  // of robots that tell none; nothing: those are left out
    Body body{};
  };
  // Strangers can make up names: more are left out.
  static constexpr std::size_t kMostRobots = 256;
  static constexpr std::size_t kMostOrdersWaiting = 64;
  static constexpr std::chrono::seconds kStateEvery{30};
  static constexpr std::chrono::milliseconds kStateAtMostEvery{200};
  // A robot that was not heard for so long is presented no more.
  static constexpr std::chrono::hours kGoneAfter{1};

  Gateway(AgentId self, std::unique_ptr<exchange::RouteExchange> exchange, Options options);

  // Serves until `stop` returns true, and then says good-bye for each robot.
  [[nodiscard]] Result<void> Serve(const std::function<bool()>& stop);

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Robot {
    Vehicle vehicle;
    std::unique_ptr<BrokerLink> link{};
    std::uint64_t connections = 0;  // those that were greeted
    std::optional<Connection> told{};
    std::string told_events{};
    Time told_at{};
    Time heard_at{};
    std::uint32_t connection_headers = 0;
    std::uint32_t state_headers = 0;
    std::uint32_t factsheet_headers = 0;
  };
  // A question for a server's network, and then for the routes that robots follow, page after page,
  // since the network need not list a route that nothing joins.
  struct NetworkQuestion {
    exchange::NetworkRequest request{};
    exchange::CatalogRequest routes{};
    std::vector<std::string> lines{};
    bool has_network = false;
    Time began{};
    Time ask_at{};
  };
  // An order is judged by a network that was asked for after it had come.
  struct WaitingOrder {
    AgentId robot{};
    std::string text{};
    bool asked = false;
  };

  [[nodiscard]] Result<void> Step(Time now);
  void Hear(const exchange::Message& message, Time now);
  void Meet(const exchange::AgentStatus& status, Time now);
  [[nodiscard]] Result<void> Present(Robot& robot);
  void TakeFromBroker(Robot& robot, Time now);
  void AskServers(Time now);
  void Hear(const exchange::NetworkReply& reply, Time now);
  void Hear(const exchange::CatalogReply& reply, Time now);
  void HasNetwork(Result<Graph> graph, Time now);
  void JudgeOrders(Time now);
  void TellBroker(Robot& robot, Time now);
  void TellConnection(Robot& robot, Connection connection);
  static void SayGoodbye(Robot& robot);
  void DropGone(Time now);
  [[nodiscard]] const Graph* graph() const { return graph_ ? &*graph_ : nullptr; }

  const AgentId self_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
  const Options options_;
  std::map<AgentId, Robot> robots_;
  std::set<AgentId> left_out_;  // and told so
  ChargingWatch charging_{self_};
  std::optional<Graph> graph_{};
  std::optional<NetworkQuestion> network_question_{};
  Time network_at_{};
  std::optional<fleet::MissionQuestion> missions_question_{};
  Time missions_at_{};
  std::deque<WaitingOrder> waiting_{};
};

}  // namespace trailcast::vda5050
