#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::fleet {

// How routes are joined and what is closed or limited, a line each (network/words.h). Errors:
// kUnavailable where no server answers within `timeout`, or one that keeps no network.
[[nodiscard]] Result<std::vector<std::string>> AskForNetwork(exchange::RouteExchange& exchange,
                                                             const AgentId& client,
                                                             std::chrono::milliseconds timeout);

// The way to a place, ROUTE@METRES, from another or from where a robot of this name stands: what a
// mission's orders have, a stretch each; none: it is there already.
[[nodiscard]] Result<std::vector<std::string>> AskForWay(exchange::RouteExchange& exchange,
                                                         const AgentId& client,
                                                         const std::string& from,
                                                         const std::string& to,
                                                         std::chrono::milliseconds timeout);

// A way to a place as one mission's orders; none: it is there already. kInvalidArgument: it has
// more stretches than one holds.
[[nodiscard]] Result<std::string> OrdersAlong(const std::vector<std::string>& way,
                                              const std::string& to);

// Has the servers in reach change it, in words; the first reply has what is so now, or, of joints
// that are parted, was so.
[[nodiscard]] Result<std::vector<std::string>> AskToJoin(exchange::RouteExchange& exchange,
                                                         const AgentId& client,
                                                         const std::string& words,
                                                         std::chrono::milliseconds timeout);

// For people; and for programs, an object. What is not understood, of a newer server, is in the
// first alone.
[[nodiscard]] std::string NetworkText(const std::vector<std::string>& lines);
[[nodiscard]] std::string NetworkJson(const std::vector<std::string>& lines);
[[nodiscard]] std::string WayText(const std::vector<std::string>& way);
[[nodiscard]] std::string WayJson(const std::vector<std::string>& way);

}  // namespace trailcast::fleet
