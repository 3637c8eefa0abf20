#pragma once

#include <array>
#include <cstdint>

#include "services/exchange/messages.h"

namespace trailcast::fleet {

// What a robot does, as pages, programs and commands say it.
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

// `offline`: nothing is heard of it. `last`: the newest mission that it has taken; null: none.
[[nodiscard]] RobotState RobotStateOf(const exchange::AgentStatus& status, bool offline,
                                      const mission::Report* last);
[[nodiscard]] const char* ToText(RobotState state);
[[nodiscard]] const char* ToText(exchange::AgentRole role);

}  // namespace trailcast::fleet
