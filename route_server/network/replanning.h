#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "route_server/fleet/mission_registry.h"
#include "route_server/network/network_registry.h"
#include "services/base/newest_map.h"

namespace trailcast::server {

// Sends robots that are on their way to a place (mission::Going) another path if theirs is closed
// or they report that they are off it. Without a path, it makes them stop and wait. It plans from
// where a robot will be once it has heard of it. A robot in a closed section drives on out of it.
// It has no clock of its own.
class Replanning {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // For a moving robot: how old its report of its place may be, and how long the answer takes.
  static constexpr double kHearsWithin_s = 1.0;
  static constexpr double kTakesPlace_m = 0.2;
  // A robot further past the place where it had to leave a route has missed it.
  static constexpr double kBeyond_m = 0.5;
  static constexpr std::chrono::seconds kAgainAfter{3};
  // For a robot whose place is not known yet, or that may miss the beginning of its new path.
  static constexpr std::chrono::seconds kLookEvery{2};

  // Both must outlive this.
  Replanning(MissionRegistry& missions, NetworkRegistry& network)
      : missions_(missions), network_(network) {}

  // Looks at all robots after an edit, and returns a line on each whose path changes, for the
  // edit's author.
  [[nodiscard]] std::vector<std::string> LookAtAll(Time now);
  // Looks at a robot that was heard, for changes since the last look. Returns a line for the log,
  // or an empty text if it goes on as before.
  [[nodiscard]] std::string Look(const AgentId& agent, Time now);

 private:
  struct Rest;
  [[nodiscard]] Result<Rest> RestOf(const mission::Record& record);
  static void TakeFrom(const std::vector<network::Section>& all, std::size_t said, bool drives,
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
  MissionRegistry& missions_;
  NetworkRegistry& network_;
  NewestMap<AgentId, Seen> seen_{MissionRegistry::kMostAgents};
};

}  // namespace trailcast::server
