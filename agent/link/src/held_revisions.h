#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// What an agent tells of its own store: the revisions of which all is there, newest first, as many
// as a status carries.
[[nodiscard]] Result<std::vector<route::RouteKey>> HeldRevisions(store::RouteStore& store);

}  // namespace trailcast::agent
