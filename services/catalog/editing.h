#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/route/route_edit.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// The revisions that an edit changes, as they are afterwards, each an edition later; none if all is
// so already. Writes nothing. kInvalidArgument, kNotFound or kConflict, saying what to do instead.
[[nodiscard]] Result<std::vector<route::RouteInfo>> PlanEdit(const route::RouteEdit& edit,
                                                             store::RouteStore& store);

}  // namespace trailcast::catalog
