#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::fleet {

// Asks all servers in reach what each keeps, in words of the network (network/words.h), and returns
// the lines of those that answer within a second after the first: all of them, or at least `enough`
// of a server. Fails with kUnavailable if none answers within `timeout`, or with what one says if
// all refuse.
[[nodiscard]] Result<std::map<AgentId, std::vector<std::string>>> AskAllForLines(
    exchange::RouteExchange& exchange, const AgentId& client, const std::string& words,
    std::chrono::milliseconds timeout,
    std::size_t enough = std::numeric_limits<std::size_t>::max());

}  // namespace trailcast::fleet
