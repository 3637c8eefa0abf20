#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/base/result.h"
#include "services/joints/compare_along.h"
#include "services/plot/drawing.h"
#include "services/route/route.h"

namespace trailcast::tool {

// Two complete revisions, and what is otherwise on the second.
struct RouteDiff {
  route::RouteInfo a;
  route::RouteInfo b;
  joints::Comparison found;
};

// A table of the stretches that differ, and a line that sums up; for programs, an object with all
// parts besides.
[[nodiscard]] std::string DiffText(const RouteDiff& diff);
[[nodiscard]] nlohmann::ordered_json DiffJson(const RouteDiff& diff);

// Along the first route's path: how many features a metre stayed, went and came, and how far aside
// the second's path is, where that is known. kInvalidArgument: they do not go the same way.
[[nodiscard]] Result<plot::Drawing> DrawDiff(const RouteDiff& diff);

}  // namespace trailcast::tool
