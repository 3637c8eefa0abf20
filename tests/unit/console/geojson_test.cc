#include "services/console/src/geojson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace trailcast::console {
namespace {

const RouteId kRoute("0123456789abcdef0123456789abcdef");
constexpr const char* kShape =
    R"({"teaching": "7", "length": 14.0, "points": {"x_m": [0, 10, 10], "y_m": [0, 0, 4]}})";
constexpr double kMetresADegree = 111'195.0;

TEST(GeoJson, APlacedRouteIsALineWhereItLies) {
  const Placement north{.x_m = 100.0, .y_m = 50.0, .heading_rad = std::numbers::pi / 2.0};
  const auto made = GeoJsonOf(kRoute, kShape, north, {.longitude_deg = 11.5, .latitude_deg = 60.0});
  ASSERT_TRUE(made) << made.error().message;
  const auto feature = nlohmann::json::parse(made->dump());
  EXPECT_EQ(feature["type"], "Feature");
  EXPECT_EQ(feature["id"], kRoute.value());
  EXPECT_EQ(feature["properties"]["length_m"], 14.0);
  EXPECT_EQ(feature["geometry"]["type"], "LineString");
  const auto line = feature["geometry"]["coordinates"];
  ASSERT_EQ(line.size(), 3U);
  const auto is_at = [&](std::size_t point, double east_m, double north_m) {
    ASSERT_EQ(line[point].size(), 2U) << "longitude, latitude";
    const double east = (line[point][0].get<double>() - 11.5) * kMetresADegree / 2.0;
    EXPECT_NEAR(east, east_m, 0.02) << "a degree is half as long there";
    EXPECT_NEAR((line[point][1].get<double>() - 60.0) * kMetresADegree, north_m, 0.02);
  };
  is_at(0, 100.0, 50.0);
  is_at(1, 100.0, 60.0);
  is_at(2, 96.0, 60.0);
}

TEST(GeoJson, ALengthenedRouteIsDrawnSo) {
  const auto made = GeoJsonOf(kRoute, kShape, {.scale = 2.0}, {});
  ASSERT_TRUE(made);
  EXPECT_NEAR((*made)["geometry"]["coordinates"][1][0].get<double>() * kMetresADegree, 20.0, 0.02);
}

TEST(GeoJson, WithoutOdometryThereIsNoLine) {
  EXPECT_FALSE(GeoJsonOf(kRoute, R"({"points": {"x_m": [], "y_m": []}})", {}, {}));
  EXPECT_FALSE(GeoJsonOf(kRoute, "not json", {}, {}));
}

}  // namespace
}  // namespace trailcast::console
