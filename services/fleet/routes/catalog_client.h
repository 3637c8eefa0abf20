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

// Asks every server in reach for its routes, and gives the first reply. The question is repeated
// until then, for a server that joins late. Errors: kUnavailable when no server answers within
// `timeout` (and how to look further); what a server says it could not do.
[[nodiscard]] Result<exchange::CatalogReply> AskCatalog(exchange::RouteExchange& exchange,
                                                        const AgentId& client,
                                                        const route::RouteQuery& query,
                                                        std::chrono::milliseconds timeout);

// Has the servers in reach change a route's labels; the first reply has the revisions that changed.
// Errors as above.
[[nodiscard]] Result<exchange::CatalogReply> AskToEdit(exchange::RouteExchange& exchange,
                                                       const AgentId& client,
                                                       const route::RouteEdit& edit,
                                                       std::chrono::milliseconds timeout);

// Page after page, until there are `limit` routes or no more. Each page may take `timeout`.
[[nodiscard]] Result<exchange::CatalogReply> AskForRoutes(exchange::RouteExchange& exchange,
                                                          const AgentId& client,
                                                          route::RouteQuery query,
                                                          std::size_t limit,
                                                          std::chrono::milliseconds timeout);

// For people: one line a route, with an id by which every command finds it ("a3f9c21@2": revision
// 2); `now_unix_ms` for their ages.
[[nodiscard]] std::string RoutesTable(const exchange::CatalogReply& reply,
                                      std::int64_t now_unix_ms);
// For programs: an object; with who holds it and what is lost of it, as the reply tells; and an
// array of these, with what was found out of some besides.
[[nodiscard]] nlohmann::ordered_json RouteJson(const route::RouteInfo& info);
[[nodiscard]] nlohmann::ordered_json RouteJson(const route::RouteInfo& info,
                                               const exchange::CatalogReply& reply);
[[nodiscard]] nlohmann::ordered_json RoutesJson(const exchange::CatalogReply& reply,
                                                const RouteStudies& studies = {});

}  // namespace trailcast::fleet
