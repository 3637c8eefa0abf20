#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/route/route_edit.h"
#include "services/store/route_store.h"

namespace trailcast::catalog {

// Returns the revisions that an edit changes, as they are afterwards, each with the next edition
// number. The result is empty if nothing is to change. It writes nothing. kInvalidArgument,
// kNotFound and kConflict say what to do instead.
[[nodiscard]] Result<std::vector<route::RouteInfo>> PlanEdit(const route::RouteEdit& edit,
                                                             store::RouteStore& store);

}  // namespace trailcast::catalog
