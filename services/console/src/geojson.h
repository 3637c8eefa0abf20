#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/console/site.h"

namespace trailcast::console {

// Makes a GeoJSON Feature (RFC 7946) of a route that was placed on a site: a line in WGS 84 by the
// odometry of its scout. `shape` is openapi.yaml's RouteShape, and `origin` the place of the site's
// lower left corner. kInvalidArgument means that the route has no line, because it was taught
// without odometry.
[[nodiscard]] Result<nlohmann::ordered_json> GeoJsonOf(const RouteId& route,
                                                       const std::string& shape,
                                                       const Placement& placement,
                                                       const Origin& origin);

}  // namespace trailcast::console
