#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "route_server/fleet/mission_registry.h"
#include "route_server/network/charging_rules.h"
#include "route_server/network/network_registry.h"
#include "services/base/newest_map.h"
#include "services/base/told_lately.h"

namespace trailcast::server {

// Sends robots whose battery is low to a free dock once their present mission has ended, and has
// their queues go on once they are charged. Its decisions are in charging_rules.h. A mission to
// charge is one of its robot's queue, before the others, so that operators see it, hold it and
// cancel it as they do others. It has no clock of its own.
class Charging {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kLookEvery{1};
  // A robot within so many metres of a dock is at it.
  static constexpr double kAtDock_m = 0.5;
  // One that has arrived there may stand so far beside it.
  static constexpr double kBesideDock_m = 2.0;

  // Sends missions in the name of `server`. Both registries must outlive this.
  Charging(AgentId server, MissionRegistry& missions, NetworkRegistry& network)
      : server_(std::move(server)), missions_(missions), network_(network) {}

  // Hears robots' batteries, and who is told to resume.
  void Hear(const exchange::Message& message);
  void Tick(Time now, std::int64_t now_unix_ms);
  // Returns why the first mission of a robot's queue has to wait: the robot charges, or another one
  // has the dock, or there is none for it; or an empty text.
  [[nodiscard]] std::string WhyNot(const mission::Record& first);
  // Returns trouble since the last call, a line each, for the log.
  [[nodiscard]] std::vector<std::string> TakeTroubles() { return std::exchange(troubles_, {}); }

 private:
  using Dock = NetworkRegistry::Dock;
  struct Robot {
    bool is_heard = false;  // and takes missions
    std::optional<std::uint8_t> battery_percent{};
    std::string gone_on{};      // the mission to charge after which it may go on
    std::string moved_after{};  // likewise: somebody says that it is not at the dock any more
    std::string no_dock{};      // why none was chosen for its mission to charge
    std::string last_text{};    // for people
  };

  [[nodiscard]] RobotSeen SeenOf(const AgentId& agent, const Robot& robot);
  [[nodiscard]] const Dock* DockAt(const network::Place& place, double within_m = kAtDock_m) const;
  [[nodiscard]] const Dock* DockOf(const mission::Record& record) const;
  [[nodiscard]] const mission::Record* WaitingToCharge(const AgentId& agent) const;
  [[nodiscard]] bool IsLost(const AgentId& agent);
  void NoteHolders();
  void Hold(Dock& dock, const std::set<AgentId>& holders);
  void Look(const AgentId& agent, Robot& robot, Time now, std::int64_t now_unix_ms);
  void Send(const AgentId& agent, Time now, std::int64_t now_unix_ms);
  // Chooses a dock for a robot that can set out, or gives the one that was chosen back.
  void Choose(const AgentId& agent, Robot& robot, const mission::Record& waiting);
  [[nodiscard]] std::string TextOf(const AgentId& agent, const Robot& robot);
  void MakeRoom(Time now, std::int64_t now_unix_ms);
  void Check(const Result<void>& done);
  void Warn(const std::string& trouble);

  AgentId server_;
  MissionRegistry& missions_;
  NetworkRegistry& network_;
  std::vector<Dock> docks_;  // as they were last looked at
  NewestMap<AgentId, Robot> robots_{MissionRegistry::kMostAgents};
  bool was_on_ = false;  // robots were sent to charge
  std::optional<Time> look_at_{};
  // Each second it tries again, and would say the same.
  ToldLately told_{std::chrono::milliseconds(60'000)};
  std::vector<std::string> troubles_;
};

}  // namespace trailcast::server
