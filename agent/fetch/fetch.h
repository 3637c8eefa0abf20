#pragma once

#include <memory>

#include "agent/diagnosis/summary.h"
#include "agent/link/follower_link.h"

namespace trailcast::agent {

// Brings a route into the agent's own store without following it, so that it is there when an
// operator activates it, and out of reach of a server. Ends when all of it is there; kUnavailable
// when nothing new has come for `options.wait`, or `options.stop` says so: what came is kept.
[[nodiscard]] Result<Summary> Fetch(const FollowerLinkOptions& options,
                                    std::unique_ptr<store::RouteStore> store,
                                    std::unique_ptr<exchange::RouteExchange> exchange);

}  // namespace trailcast::agent
