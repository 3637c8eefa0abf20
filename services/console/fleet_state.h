#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"

namespace trailcast::console {

// What is known of the fleet: who was heard of it, what each was sent to do, which routes there
// are. Robots that have fallen silent stay. No I/O, no clock of its own.
class FleetState {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Strangers can make up names: beyond these the one goes that was not heard for longest.
  static constexpr std::size_t kMostAgents = 1024;
  static constexpr std::size_t kMostMissions = 256;
  static constexpr std::size_t kMissionsShown = 50;
  // An agent speaks five times a second; in a large fleet each has program::Presence's share.
  static constexpr std::chrono::milliseconds kSilentAfter{3000};

  // `self` asks for routes and missions: replies to it are taken.
  explicit FleetState(AgentId self) : self_(std::move(self)) {}

  void Handle(const exchange::Message& message, Time now, std::int64_t unix_ms);
  // What this console itself sends: without a server nobody else tells its orders.
  void Sent(const mission::Mission& mission, std::int64_t unix_ms);
  // Who has fallen silent meanwhile.
  void Tick(Time now);
  // A robot tells of a mission whose orders are not known here.
  [[nodiscard]] bool lacks_orders() const { return lacks_orders_; }

  // The object that openapi.yaml calls State, without its time.
  [[nodiscard]] std::string Json() const;

 private:
  struct Agent {
    exchange::AgentStatus status{};
    Time heard_at{};
    std::int64_t heard_unix_ms = 0;
    bool gone = false;
    bool silent = false;
  };
  using MissionName = std::pair<AgentId, std::string>;

  void On(const mission::Report& report, std::int64_t unix_ms);
  void On(const exchange::MissionReply& reply);
  void On(const exchange::CatalogReply& reply);
  [[nodiscard]] const mission::Record* LatestOf(const AgentId& robot) const;

  AgentId self_;
  NewestMap<AgentId, Agent> agents_{kMostAgents};
  NewestMap<MissionName, mission::Record> missions_{kMostMissions};
  std::map<AgentId, std::vector<route::RouteInfo>> routes_;  // of each server
  bool lacks_orders_ = false;
};

}  // namespace trailcast::console
