#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"
#include "services/network/changes.h"
#include "services/network/passing.h"

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

// The routes that pass at a place, ROUTE@METRES or what one is called.
[[nodiscard]] Result<network::Passings> AskWhatPasses(exchange::RouteExchange& exchange,
                                                      const AgentId& client,
                                                      const std::string& place,
                                                      std::chrono::milliseconds timeout);

// What was changed then or later of routes and of how they are joined, as one server has kept it.
[[nodiscard]] Result<network::History> AskForChanges(exchange::RouteExchange& exchange,
                                                     const AgentId& client,
                                                     std::int64_t since_unix_ms,
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
[[nodiscard]] nlohmann::ordered_json NetworkJson(const std::vector<std::string>& lines);
[[nodiscard]] std::string WayText(const std::vector<std::string>& way);
[[nodiscard]] nlohmann::ordered_json WayJson(const std::vector<std::string>& way);
[[nodiscard]] std::string PassingText(const network::Passings& passings);
[[nodiscard]] nlohmann::ordered_json PassingJson(const network::Passings& passings);
// The newest `limit` changes, the newest first, by this machine's time zone; and whether it may
// have been more.
[[nodiscard]] std::string ChangesText(const network::History& history, std::int64_t since_unix_ms,
                                      std::size_t limit);
// The same for programs, with the routes that each is about; `of`: only what is about one of these,
// by its name or whole id.
[[nodiscard]] nlohmann::ordered_json ChangesJson(const network::History& history, std::size_t limit,
                                                 std::span<const std::string> of = {});

}  // namespace trailcast::fleet
