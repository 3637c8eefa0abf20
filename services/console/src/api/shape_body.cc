#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "services/console/src/shape.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using program::Json;
using program::Rounded;
using program::RoundedOrNull;

Json CellsValue(const std::vector<ShapeCell>& cells) {
  Json begin = Json::array();
  Json features = Json::array();
  Json roughness = Json::array();
  Json slope_rad = Json::array();
  for (const ShapeCell& cell : cells) {
    begin.push_back(Rounded(cell.begin, 100.0));
    features.push_back(cell.features);
    roughness.push_back(cell.roughness ? Json(route::NameOf(*cell.roughness)) : Json(nullptr));
    slope_rad.push_back(RoundedOrNull(cell.slope_rad, 1000.0));
  }
  return {{"begin", std::move(begin)},
          {"features", std::move(features)},
          {"roughness", std::move(roughness)},
          {"slope_rad", std::move(slope_rad)}};
}

// Returns how much of the path has which roughness, and its steepest slopes. Values that were not
// measured are null.
Json TerrainValue(const RouteShape& shape) {
  Json rough = Json::object();
  std::optional<double> up_rad;
  std::optional<double> down_rad;
  std::map<route::Roughness, double> extents;
  for (const ShapeCell& cell : shape.cells) {
    if (cell.roughness) extents[*cell.roughness] += cell.end - cell.begin;
    if (!cell.slope_rad) continue;
    up_rad = std::max(up_rad.value_or(0.0), *cell.slope_rad);
    down_rad = std::max(down_rad.value_or(0.0), -*cell.slope_rad);
  }
  for (const auto& [roughness, extent] : extents) {
    const double share = shape.length > 0.0 ? extent / shape.length : 1.0;
    rough[std::string(route::NameOf(roughness))] = Rounded(share, 1000.0);
  }
  return {{"shares", extents.empty() ? Json(nullptr) : std::move(rough)},
          {"up_rad", RoundedOrNull(up_rad, 1000.0)},
          {"down_rad", RoundedOrNull(down_rad, 1000.0)}};
}

Json PointsValue(const std::vector<ShapePoint>& points) {
  Json along = Json::array();
  Json x_m = Json::array();
  Json y_m = Json::array();
  for (const ShapePoint& point : points) {
    along.push_back(Rounded(point.along, 100.0));
    x_m.push_back(Rounded(point.x_m, 1000.0));
    y_m.push_back(Rounded(point.y_m, 1000.0));
  }
  return {{"along", std::move(along)}, {"x_m", std::move(x_m)}, {"y_m", std::move(y_m)}};
}

}  // namespace

std::string ShapeBody(const route::RouteKey& key, const RouteShape& shape) {
  Json weak = Json::array();
  for (const view::WeakPlace& place : shape.weak_places) {
    weak.push_back({{"begin", Rounded(place.begin, 100.0)},
                    {"end", Rounded(place.end, 100.0)},
                    {"why", NameOf(place.why)},
                    {"features", place.features}});
  }
  Json closing;
  if (shape.closing) {
    closing = {{"gap_m", Rounded(shape.closing->gap_m, 100.0)},
               {"turn_rad", Rounded(shape.closing->turn_rad, 1000.0)}};
  }
  return program::OneLine({{"route", key.route.value()},
                           {"teaching", fmt::format("{:x}", key.teaching.value())},
                           {"unit", shape.has_odometry ? "m" : "s"},
                           {"length", Rounded(shape.length, 100.0)},
                           {"segments", shape.segments},
                           {"segments_a_cell", shape.segments_a_cell},
                           {"cells", CellsValue(shape.cells)},
                           {"terrain", TerrainValue(shape)},
                           {"points", PointsValue(shape.points)},
                           {"closing", std::move(closing)},
                           {"weak_places", std::move(weak)}});
}

}  // namespace trailcast::console
