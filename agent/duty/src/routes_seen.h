#pragma once

#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// Names of the routes in a robot's own store that are not retired, and that somewhere look like a
// view (vision::DescribeForQuery), the likest first, three at most. By key views alone: that a
// robot stands there is for their features to tell. Of the newest routes no more segments are
// looked at than take some tenths of a second. What cannot be read shows nothing.
[[nodiscard]] std::vector<std::string> RoutesSeen(store::RouteStore& store,
                                                  const std::vector<route::ViewFeature>& view);

}  // namespace trailcast::agent
