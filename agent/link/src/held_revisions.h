#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// Returns the revisions that the agent's store has completely, the newest first, as many as a
// status holds.
[[nodiscard]] Result<std::vector<route::RouteKey>> HeldRevisions(store::RouteStore& store);

}  // namespace trailcast::agent
