#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"
#include "services/fleet/routes/route_study.h"

namespace trailcast::fleet {

// Asks every server in reach for its routes, and returns the first reply. The question is repeated
// until then, because a server may join late. Fails with kUnavailable when no server answers within
// `timeout`, which says how to look further, and with what a server says it could not do.
[[nodiscard]] Result<exchange::CatalogReply> AskCatalog(exchange::RouteExchange& exchange,
                                                        const AgentId& client,
                                                        const route::RouteQuery& query,
                                                        std::chrono::milliseconds timeout);

// Asks the servers in reach to change a route's labels. The first reply has the revisions that
// changed. Errors are as above.
[[nodiscard]] Result<exchange::CatalogReply> AskToEdit(exchange::RouteExchange& exchange,
                                                       const AgentId& client,
                                                       const route::RouteEdit& edit,
                                                       std::chrono::milliseconds timeout);

// Asks for page after page, until there are `limit` routes or no more. Each page may take
// `timeout`.
[[nodiscard]] Result<exchange::CatalogReply> AskForRoutes(exchange::RouteExchange& exchange,
                                                          const AgentId& client,
                                                          route::RouteQuery query,
                                                          std::size_t limit,
                                                          std::chrono::milliseconds timeout);

// Returns a table for people, with one line for each route and an id by which every command finds
// it ("a3f9c21@2" is revision 2). `now_unix_ms` is for their ages.
[[nodiscard]] std::string RoutesTable(const exchange::CatalogReply& reply,
                                      std::int64_t now_unix_ms);
// These return, for programs, an object; an object with its holders and what is lost of it, as the
// reply tells; and an array of these, with what was found out about some of them.
[[nodiscard]] nlohmann::ordered_json RouteJson(const route::RouteInfo& info);
[[nodiscard]] nlohmann::ordered_json RouteJson(const route::RouteInfo& info,
                                               const exchange::CatalogReply& reply);
[[nodiscard]] nlohmann::ordered_json RoutesJson(const exchange::CatalogReply& reply,
                                                const RouteStudies& studies = {});

}  // namespace trailcast::fleet
