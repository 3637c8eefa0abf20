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

// Returns how routes are joined and what is closed or limited, one line each (network/words.h).
// Fails with kUnavailable if no server answers within `timeout`, or one that keeps no network.
[[nodiscard]] Result<std::vector<std::string>> AskForNetwork(exchange::RouteExchange& exchange,
                                                             const AgentId& client,
                                                             std::chrono::milliseconds timeout);

// Returns the path to a place, ROUTE@METRES, from another or from where a robot of this name is, in
// the words of a mission's orders, one section in each line. It is empty if that is the same place.
[[nodiscard]] Result<std::vector<std::string>> AskForWay(exchange::RouteExchange& exchange,
                                                         const AgentId& client,
                                                         const std::string& from,
                                                         const std::string& to,
                                                         std::chrono::milliseconds timeout);

// Returns the routes that pass at a place, which is ROUTE@METRES or a place's name.
[[nodiscard]] Result<network::Passings> AskWhatPasses(exchange::RouteExchange& exchange,
                                                      const AgentId& client,
                                                      const std::string& place,
                                                      std::chrono::milliseconds timeout);

// Returns the changes since then of routes and of how they are joined, as one server has kept them.
[[nodiscard]] Result<network::History> AskForChanges(exchange::RouteExchange& exchange,
                                                     const AgentId& client,
                                                     std::int64_t since_unix_ms,
                                                     std::chrono::milliseconds timeout);

// Returns a path to a place as one mission's orders, which are empty if the path is. Fails with
// kInvalidArgument for more sections than a mission holds.
[[nodiscard]] Result<std::string> OrdersAlong(const std::vector<std::string>& way,
                                              const std::string& to);

// Asks the servers in reach for a change of the network, in words. The first reply has what holds
// now or, for junctions that are removed, what held before.
[[nodiscard]] Result<std::vector<std::string>> AskToJoin(exchange::RouteExchange& exchange,
                                                         const AgentId& client,
                                                         const std::string& words,
                                                         std::chrono::milliseconds timeout);

// These return text for people, and an object for programs. Lines that are not understood, from a
// newer server, are in the text alone.
[[nodiscard]] std::string NetworkText(const std::vector<std::string>& lines);
[[nodiscard]] nlohmann::ordered_json NetworkJson(const std::vector<std::string>& lines);
[[nodiscard]] std::string WayText(const std::vector<std::string>& way);
[[nodiscard]] nlohmann::ordered_json WayJson(const std::vector<std::string>& way);
[[nodiscard]] std::string PassingText(const network::Passings& passings);
[[nodiscard]] nlohmann::ordered_json PassingJson(const network::Passings& passings);
// Returns the newest `limit` changes, the newest first, in this machine's time zone, and whether
// there may be more.
[[nodiscard]] std::string ChangesText(const network::History& history, std::int64_t since_unix_ms,
                                      std::size_t limit);
// Returns the same for programs, with the routes that each change is about. With `of`, it returns
// only changes about one of these routes, by its name or whole id.
[[nodiscard]] nlohmann::ordered_json ChangesJson(const network::History& history, std::size_t limit,
                                                 std::span<const std::string> of = {});

}  // namespace trailcast::fleet
