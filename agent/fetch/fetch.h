#pragma once

#include <memory>

#include "agent/diagnosis/summary.h"
#include "agent/link/follower_link.h"

namespace trailcast::agent {

// Fetches a route into the agent's own store without following it, so that the robot has it when an
// operator activates it and where no server is in reach. It ends when the route is complete.
// kUnavailable means that nothing new came for `options.wait`, or that `options.stop` ended it; the
// part that came is kept.
[[nodiscard]] Result<Summary> Fetch(const FollowerLinkOptions& options,
                                    std::unique_ptr<store::RouteStore> store,
                                    std::unique_ptr<exchange::RouteExchange> exchange);

}  // namespace trailcast::agent
