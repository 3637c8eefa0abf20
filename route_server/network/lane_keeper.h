#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "route_server/fleet/mission_board.h"
#include "route_server/network/network_board.h"
#include "services/base/newest_map.h"
#include "services/mission/orders.h"

namespace trailcast::server {

// Lets robots that are going to places (mission::Going) into narrow places, one at a time. Their
// orders are what lets them in: a server sends them with a 'wait lane' before each, and without
// once the place is theirs; it stays theirs until they are seen out of it. Nobody waits in one for
// another: lanes without room between them are given at once, and only once there is room beyond
// them. Robots that do not ask (sent by hand, or followers of nobody's mission) have what they are
// in, or are sent through, whoever else has it. No clock of its own.
class LaneKeeper {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Lines = std::vector<std::string>;
  // So near to the end of its orders, a robot is where it waits.
  static constexpr double kThere_m = 0.5;
  // Two that stand so near to each other are at one place: the first by name goes first.
  static constexpr double kBeside_m = 0.25;
  // How long a robot has to be out of a lane by its word: that may be older than what its mission
  // says of it.
  static constexpr std::chrono::seconds kSettled{1};
  static constexpr std::chrono::seconds kSilent{10};
  // Of a moving robot: how old its word on its place may be, and how long the answer takes.
  static constexpr double kHearsWithin_s = 1.0;
  static constexpr double kTakesPlace_m = 0.2;

  // Both outlive this.
  LaneKeeper(MissionBoard& missions, NetworkBoard& network)
      : missions_(missions), network_(network) {}

  // When a robot is heard of: lines for the log.
  [[nodiscard]] Lines Look(const AgentId& agent, Time now);
  // At the start, and after an edit: likewise, for who made it, too.
  [[nodiscard]] Lines LookAtAll(Time now);

 private:
  // A robot that is not let in is told for whom it waits.
  struct WhyNot {
    AgentId other{};
    std::string lane{};      // that it is to leave, as people call it; empty: it is ahead of it
    bool is_silent = false;  // and is not heard
    bool operator==(const WhyNot&) const = default;
  };
  struct Robot {
    std::string mission{};
    std::string orders{};
    std::uint64_t changes = 0;
    std::size_t at = 0;     // which stretch of its first leg it has come to,
    double driven_m = 0.0;  // and how far it is on that
    std::optional<Time> heard_at{};
    NetworkBoard::LaneSet out_of{};  // of what it has, and since when
    Time out_since{};
    std::optional<Time> waits_since{};  // for one,
    std::optional<WhyNot> told{};       // and was told that last
  };
  struct Rest;
  [[nodiscard]] Result<Rest> RestOf(const mission::Record& record, Robot& robot);
  // What it has by its orders and its place. True: it has left one.
  [[nodiscard]] Result<bool> Settle(const AgentId& agent, Robot& robot, Time now, Lines& lines);
  [[nodiscard]] Result<void> Bar(const mission::Record& record, const Rest& rest, Lines& lines);
  [[nodiscard]] Result<void> LetIn(const AgentId& agent, Robot& robot, Time now, Lines& lines);
  [[nodiscard]] std::optional<WhyNot> WhyNotInto(const AgentId& agent, const network::Leg& leg,
                                                 Time now);
  [[nodiscard]] static std::string ToText(const WhyNot& why_not);
  [[nodiscard]] Result<void> Amend(const mission::Record& record, const Rest& rest,
                                   const std::vector<mission::Task>& tasks, mission::Going::Why why,
                                   const std::string& because);

  MissionBoard& missions_;
  NetworkBoard& network_;
  NewestMap<AgentId, Robot> robots_{MissionBoard::kMostAgents};
  std::optional<Time> since_{};
};

}  // namespace trailcast::server
