#pragma once

#include <string>

#include "services/exchange/messages.h"

namespace trailcast::fleet {

// What a robot follows by, in one sentence for people: "Odometry: trusted". Empty of one that does
// not follow a route now.
[[nodiscard]] std::string FollowingText(const exchange::AgentStatus& status);

}  // namespace trailcast::fleet
