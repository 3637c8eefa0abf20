#pragma once

#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

// Returns the names of up to three routes in a robot's own store that are not retired and somewhere
// resemble a view (vision::DescribeForQuery), the most similar first. It compares key views only;
// whether the robot stands there, the features must tell. It looks at as many segments of the
// newest routes as some tenths of a second allow, and skips those that cannot be read.
[[nodiscard]] std::vector<std::string> RoutesSeen(store::RouteStore& store,
                                                  const std::vector<route::ViewFeature>& view);

}  // namespace trailcast::agent
