#pragma once

#include <array>
#include <cstdint>

#include "services/exchange/messages.h"

namespace trailcast::console {

// A robot is shown in one of these states.
enum class RobotState : std::uint8_t {
  kSilent,
  kStopped,
  kPaused,
  kStarting,
  kFree,
  kWaiting,
  kTeaching,
  kDriving,
  kArrived,
  kEnded,
  kFault
};
// These are openapi.yaml's words for them, in that order.
inline constexpr std::array kRobotStates{"silent",  "stopped", "paused",   "starting",
                                         "free",    "waiting", "teaching", "driving",
                                         "arrived", "ended",   "fault"};

// `on_mission`: it has one that has not ended.
[[nodiscard]] RobotState RobotStateOf(const exchange::AgentStatus& status, bool silent,
                                      bool on_mission);
[[nodiscard]] const char* ToText(RobotState state);
[[nodiscard]] const char* ToText(exchange::AgentRole role);

}  // namespace trailcast::console
