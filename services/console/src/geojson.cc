#include "services/console/src/geojson.h"

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using program::Json;
using program::Rounded;

// A degree of latitude has this many metres at the Earth's mean radius, which is accurate enough
// for a site.
constexpr double kMetresADegree = 111'195.0;
constexpr double kLeastCosine = 1e-3;  // at a pole
constexpr double kCentimetres = 1e7;   // decimals of a degree that are centimetres

}  // namespace

Result<Json> GeoJsonOf(const RouteId& route, const std::string& shape, const Placement& placement,
                       const Origin& origin) {
  Json drawn = Json::parse(shape, nullptr, /*allow_exceptions=*/false);
  if (!drawn.is_object()) drawn = Json::object();
  const Json points = drawn.value("points", Json::object());
  const Json x_m = points.value("x_m", Json::array());
  const Json y_m = points.value("y_m", Json::array());
  if (x_m.size() < 2 || x_m.size() != y_m.size()) {
    return Fail(ErrorCode::kInvalidArgument, "route {} has no line: it was taught without odometry",
                route.value());
  }
  const double east = std::max(std::cos(Radians(origin.latitude_deg)), kLeastCosine);
  const double cosine = placement.scale * std::cos(placement.heading_rad);
  const double sine = placement.scale * std::sin(placement.heading_rad);
  Json line = Json::array();
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    const double ahead_m = x_m[i].get<double>();
    const double left_m = y_m[i].get<double>();
    const double east_m = placement.x_m + cosine * ahead_m - sine * left_m;
    const double north_m = placement.y_m + sine * ahead_m + cosine * left_m;
    line.push_back({Rounded(origin.longitude_deg + east_m / (kMetresADegree * east), kCentimetres),
                    Rounded(origin.latitude_deg + north_m / kMetresADegree, kCentimetres)});
  }
  return Json{{"type", "Feature"},
              {"id", route.value()},
              {"properties",
               {{"route", route.value()},
                {"teaching", drawn.value("teaching", "")},
                {"length_m", drawn.value("length", 0.0)}}},
              {"geometry", {{"type", "LineString"}, {"coordinates", std::move(line)}}}};
}

}  // namespace trailcast::console
