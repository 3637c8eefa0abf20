#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "services/base/ids.h"
#include "services/network/words.h"

namespace trailcast::server {

// These rules decide when robots charge, and at which dock. They have no state, and Charging gives
// them what they need.

// This is a robot as the rules see it.
struct RobotSeen {
  AgentId agent{};
  std::optional<std::uint8_t> battery_percent{};  // if it is heard and tells it
  bool is_sent = false;  // a mission to charge waits for it, or is under way
  std::string dock{};    // its last mission brought it there to charge; empty for none
  // Since then its battery has been full enough, or it was told to resume.
  bool may_go_on = false;
};

[[nodiscard]] bool IsToCharge(const RobotSeen& robot, const network::ChargeLimits& limits);
// Returns "charges at dock1 ..", or an empty text for a robot that does not, or may go on.
[[nodiscard]] std::string Charges(const RobotSeen& robot, const network::ChargeLimits& limits);
[[nodiscard]] bool IsFull(const RobotSeen& robot, const network::ChargeLimits& limits);

// This is what is known of a robot and a dock.
struct Sighting {
  AgentId agent{};
  bool is_heard = false;
  bool is_placed = false;  // where it stands is known
  bool is_there = false;
  bool goes_there = false;
};
// Returns the robots that take a dock now. One that took it keeps it until it is known to be
// elsewhere, however long it is silent.
[[nodiscard]] std::set<AgentId> HoldersNow(const std::set<AgentId>& before,
                                           std::span<const Sighting> seen);
[[nodiscard]] bool IsFreeFor(const AgentId& agent, const std::set<AgentId>& holders);
// Returns "robot2 and robot3", the holders other than `agent`.
[[nodiscard]] std::string OthersIn(const std::set<AgentId>& holders, const AgentId& agent);

// This is a dock as a robot sees it that is to charge.
struct DockSeen {
  std::string name{};
  std::set<AgentId> holders{};
  std::optional<double> length_m{};  // of the path there, if one leads there
  std::string no_way{};              // why none does
};
struct DockChoice {
  std::string name{};      // the nearest free dock; empty if there is none
  std::string why_none{};  // for people
};
[[nodiscard]] DockChoice ChooseDock(const AgentId& agent, std::span<const DockSeen> docks);

}  // namespace trailcast::server
