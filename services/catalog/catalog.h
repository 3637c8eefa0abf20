#pragma once

#include "services/exchange/messages.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// Answers one request from what is stored. Never fails: what went wrong is in the reply's `error`.
// An exact name matches nothing: the reply carries the names that exist, nearest first, at most 10.
[[nodiscard]] exchange::CatalogReply Answer(const exchange::CatalogRequest& request,
                                            const AgentId& server, store::RouteStore& store);

}  // namespace trailcast::catalog
