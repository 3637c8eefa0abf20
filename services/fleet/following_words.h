#pragma once

#include <string>

#include "services/exchange/messages.h"

namespace trailcast::fleet {

// Returns in one sentence for people what a robot follows by, such as "Odometry: trusted". It is
// empty for a robot that follows no route now.
[[nodiscard]] std::string FollowingText(const exchange::AgentStatus& status);

}  // namespace trailcast::fleet
