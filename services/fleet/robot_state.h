#pragma once

#include <array>
#include <cstdint>

#include "services/exchange/messages.h"

namespace trailcast::fleet {

// This is the run status of a robot in the words of pages, programs and commands.
enum class RobotState : std::uint8_t {
  kOffline,  // it is not heard
  kStopped,
  kPaused,
  kStarting,
  kAvailable,
  kWaiting,
  kTeaching,
  kDriving,
  kArrived,
  kFailed,  // it takes missions, and stands where its last one failed
  kShutDown,
  kFault
};
inline constexpr std::array kRobotStates{"offline",   "stopped", "paused",    "starting",
                                         "available", "waiting", "teaching",  "driving",
                                         "arrived",   "failed",  "shut down", "fault"};

// A robot is `offline` if it is not heard. `last` is the newest mission that it has taken, or null.
[[nodiscard]] RobotState RobotStateOf(const exchange::AgentStatus& status, bool offline,
                                      const mission::Report* last);
[[nodiscard]] const char* ToText(RobotState state);
[[nodiscard]] const char* ToText(exchange::AgentRole role);

}  // namespace trailcast::fleet
