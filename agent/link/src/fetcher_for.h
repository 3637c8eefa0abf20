#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/exchange/route_fetcher.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// Fetches what of a revision is not among `held`, which is in the own store. What the store's other
// revisions of that route have is taken from there. `store` outlives it.
[[nodiscard]] Result<exchange::RouteFetcher> FetcherFor(
    const AgentId& self, const route::RouteKey& key,
    const std::vector<exchange::RouteFetcher::Held>& held, store::RouteStore& store,
    exchange::RouteFetcher::Time now);

}  // namespace trailcast::agent
