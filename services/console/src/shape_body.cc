#include <fmt/format.h>

#include <utility>

#include "services/console/src/shape.h"
#include "services/console/src/values.h"

namespace trailcast::console {
namespace {

Json CellsValue(const std::vector<ShapeCell>& cells) {
  Json begin = Json::array();
  Json features = Json::array();
  Json roughness = Json::array();
  Json slope_rad = Json::array();
  for (const ShapeCell& cell : cells) {
    begin.push_back(Rounded(cell.begin, 100.0));
    features.push_back(cell.features);
    roughness.push_back(cell.roughness ? Json(route::NameOf(*cell.roughness)) : Json(nullptr));
    slope_rad.push_back(cell.slope_rad ? Json(Rounded(*cell.slope_rad, 1000.0)) : Json(nullptr));
  }
  return {{"begin", std::move(begin)},
          {"features", std::move(features)},
          {"roughness", std::move(roughness)},
          {"slope_rad", std::move(slope_rad)}};
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
  return Text({{"route", key.route.value()},
               {"teaching", fmt::format("{:x}", key.teaching.value())},
               {"unit", shape.has_odometry ? "m" : "s"},
               {"length", Rounded(shape.length, 100.0)},
               {"segments", shape.segments},
               {"segments_a_cell", shape.segments_a_cell},
               {"cells", CellsValue(shape.cells)},
               {"points", PointsValue(shape.points)},
               {"closing", std::move(closing)},
               {"weak_places", std::move(weak)}});
}

}  // namespace trailcast::console
