#pragma once

#include "services/exchange/messages.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// Answers one request from the store. It never fails; the reply's `error` tells what went wrong. If
// nothing has the exact name, the reply has up to 10 existing names, the nearest first.
[[nodiscard]] exchange::CatalogReply Answer(const exchange::CatalogRequest& request,
                                            const AgentId& server, store::RouteStore& store);

}  // namespace trailcast::catalog
