#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "route_server/fleet/mission_board.h"
#include "route_server/network/network_board.h"
#include "services/base/newest_map.h"

namespace trailcast::server {

// Has robots that are going to a place (mission::Going) go another way when theirs is closed, or
// when they say that they are off it, and stand where they are and wait where there is none. It
// plans from where a robot will be once it has heard of it; one that is on a closed part drives on
// out of it. No clock of its own.
class Replanning {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Of a moving robot: how old its word on its place may be, and how long the answer takes.
  static constexpr double kHearsWithin_s = 1.0;
  static constexpr double kTakesPlace_m = 0.2;
  // Further beyond where it was to leave a route it has missed that.
  static constexpr double kBeyond_m = 0.5;
  static constexpr std::chrono::seconds kAgainAfter{3};
  // One whose place is not known yet, or that may miss where its other way begins.
  static constexpr std::chrono::seconds kLookEvery{2};

  // Both outlive this.
  Replanning(MissionBoard& missions, NetworkBoard& network)
      : missions_(missions), network_(network) {}

  // After an edit: what becomes of each robot whose way it changes, a line each for who made it.
  [[nodiscard]] std::vector<std::string> LookAtAll(Time now);
  // When a robot is heard of: whatever has changed since it was looked at last. A line for the log;
  // empty: it goes on as before.
  [[nodiscard]] std::string Look(const AgentId& agent, Time now);

 private:
  struct Rest;
  [[nodiscard]] Result<Rest> RestOf(const mission::Record& record);
  static void TakeFrom(const std::vector<network::Stretch>& all, std::size_t said, bool drives,
                       bool laps, Rest& rest);
  [[nodiscard]] Result<std::string> Replan(const mission::Record& record, const Rest& rest);
  struct Plan;
  [[nodiscard]] Result<Plan> PlanOn(const Rest& rest, double ahead_m);

  struct Seen {
    std::string mission{};
    std::uint64_t changes = 0;
    bool settled = false;  // until something changes
    Time looked_at{};
    Time amended_at{};
  };
  MissionBoard& missions_;
  NetworkBoard& network_;
  NewestMap<AgentId, Seen> seen_{MissionBoard::kMostAgents};
};

}  // namespace trailcast::server
