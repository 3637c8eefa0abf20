#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/exchange/route_fetcher.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// Returns a fetcher for the segments of a revision that are not among `held`, which are in the own
// store. It copies segments from the store's other revisions of that route if they have them.
// `store` must outlive it.
[[nodiscard]] Result<exchange::RouteFetcher> FetcherFor(
    const AgentId& self, const route::RouteKey& key,
    const std::vector<exchange::RouteFetcher::Held>& held, store::RouteStore& store,
    exchange::RouteFetcher::Time now);

}  // namespace trailcast::agent
