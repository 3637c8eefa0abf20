#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "route_server/fleet/mission_registry.h"
#include "route_server/network/network_registry.h"
#include "services/base/newest_map.h"
#include "services/mission/orders.h"

namespace trailcast::server {

// Lets robots that are on their way to places (mission::Going) into mutex zones, one at a time.
// Their orders let them in: a server sends them with a 'wait lane' before each zone, and without it
// once the robot holds the zone, which lasts until the robot is seen outside. No robot waits inside
// a zone, and each has room behind it, so there is no deadlock: zones without room between them are
// granted together, and only once there is room beyond them. Robots that do not ask (sent by hand,
// or on no mission) hold the zones in which they are, or through which they are sent, whoever else
// holds them. It has no clock of its own.
class ZoneAdmission {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Lines = std::vector<std::string>;
  // A robot so near to the end of its orders is where it waits.
  static constexpr double kThere_m = 0.5;
  // Two robots so near to each other are at one place; the first by name goes first.
  static constexpr double kBeside_m = 0.25;
  // How long a robot must report a place outside a zone, because the report may be older than that
  // of its mission.
  static constexpr std::chrono::seconds kSettled{1};
  static constexpr std::chrono::seconds kSilent{10};
  // For a moving robot: how old its report of its place may be, and how long the answer takes.
  static constexpr double kHearsWithin_s = 1.0;
  static constexpr double kTakesPlace_m = 0.2;

  // Both must outlive this.
  ZoneAdmission(MissionRegistry& missions, NetworkRegistry& network)
      : missions_(missions), network_(network) {}

  // Looks at a robot that was heard, and returns lines for the log.
  [[nodiscard]] Lines Look(const AgentId& agent, Time now);
  // Looks at all, at the start and after an edit, and returns the lines also for the edit's author.
  [[nodiscard]] Lines LookAtAll(Time now);

 private:
  // Tells a robot that is not let in for whom it waits.
  struct WhyNot {
    AgentId other{};
    std::string lane{};      // the zone that the other must leave, as people call it; if empty, the
                             // other is ahead of it
    bool is_silent = false;  // the other is not heard
    bool operator==(const WhyNot&) const = default;
  };
  struct Robot {
    std::string mission{};
    std::string orders{};
    std::uint64_t changes = 0;
    std::size_t at = 0;     // index of the section of its first leg that it has reached,
    double driven_m = 0.0;  // and its metres on that
    std::optional<Time> heard_at{};
    NetworkRegistry::LaneSet out_of{};  // zones that it holds but has left, and since when
    Time out_since{};
    std::optional<Time> waits_since{};  // for a zone,
    std::optional<WhyNot> told{};       // and the last reason it was told
  };
  struct Rest;
  [[nodiscard]] Result<Rest> RestOf(const mission::Record& record, Robot& robot);
  // Updates the zones that it holds, by its orders and its place. Returns true if it has left one.
  [[nodiscard]] Result<bool> Settle(const AgentId& agent, Robot& robot, Time now, Lines& lines);
  [[nodiscard]] Result<void> Bar(const mission::Record& record, const Rest& rest, Lines& lines);
  [[nodiscard]] Result<void> LetIn(const AgentId& agent, Robot& robot, Time now, Lines& lines);
  [[nodiscard]] std::optional<WhyNot> WhyNotInto(const AgentId& agent, const network::Leg& leg,
                                                 Time now);
  [[nodiscard]] static std::string ToText(const WhyNot& why_not);
  [[nodiscard]] Result<void> Amend(const mission::Record& record, const Rest& rest,
                                   const std::vector<mission::Task>& tasks, mission::Going::Why why,
                                   const std::string& because);

  MissionRegistry& missions_;
  NetworkRegistry& network_;
  NewestMap<AgentId, Robot> robots_{MissionRegistry::kMostAgents};
  std::optional<Time> since_{};
};

}  // namespace trailcast::server
