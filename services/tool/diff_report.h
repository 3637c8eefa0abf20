#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/base/result.h"
#include "services/junctions/compare_along.h"
#include "services/plot/drawing.h"
#include "services/route/route.h"

namespace trailcast::tool {

// These are two complete revisions, and the differences of the second.
struct RouteDiff {
  route::RouteInfo a;
  route::RouteInfo b;
  junctions::Comparison found;
};

// Returns a table of the sections that differ with a summary line. The JSON is an object that has
// all parts as well.
[[nodiscard]] std::string DiffText(const RouteDiff& diff);
[[nodiscard]] nlohmann::ordered_json DiffJson(const RouteDiff& diff);

// Draws along the first route's path how many features a metre stayed, went and came, and how far
// aside the second's path is, where that is known. Returns kInvalidArgument if they do not go the
// same way.
[[nodiscard]] Result<plot::Drawing> DrawDiff(const RouteDiff& diff);

}  // namespace trailcast::tool
