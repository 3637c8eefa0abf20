#pragma once

#include <array>

#include "services/exchange/messages.h"

namespace trailcast::console {

// What robots do, in the words of openapi.yaml.
inline constexpr std::array kRobotStates{"silent",  "stopped", "paused",   "starting",
                                         "free",    "waiting", "teaching", "driving",
                                         "arrived", "ended",   "fault"};

// `on_mission`: it has one that has not ended.
[[nodiscard]] const char* RobotState(const exchange::AgentStatus& status, bool silent,
                                     bool on_mission);
[[nodiscard]] const char* ToText(exchange::AgentRole role);

}  // namespace trailcast::console
