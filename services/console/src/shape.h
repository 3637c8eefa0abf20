#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/route/terrain.h"
#include "services/view/weak_places.h"

namespace trailcast::console {

// A stretch of a route: one segment, or, of a long route, so many in a row that the cells are few.
struct ShapeCell {
  double begin = 0.0;  // along the route, as its end
  double end = 0.0;
  std::uint32_t features = 0;                   // of all its segments
  std::optional<route::Roughness> roughness{};  // the worst of it
  std::optional<double> slope_rad{};            // the mean, uphill positive

  [[nodiscard]] double features_per_unit() const {
    return end > begin ? features / (end - begin) : 0.0;
  }
};

// Metres, the route's beginning at the origin, and heading along x there; y to the left.
struct ShapePoint {
  double along = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
};

// How far its end is from its beginning, by the wheels, of a route that ends where it began.
struct ClosingError {
  double gap_m = 0.0;
  double turn_rad = 0.0;  // end's heading less beginning's, -pi to pi
};

// A taught route as it is drawn. Along it in metres; of one that was taught without odometry in
// seconds of teaching in motion.
struct RouteShape {
  bool has_odometry = false;
  double length = 0.0;
  std::uint32_t segments = 0;
  std::uint32_t segments_a_cell = 1;
  std::vector<ShapeCell> cells;
  // By the scout's wheels, which drift: no map. Of a loop closed, for drawing only; none without
  // odometry.
  std::vector<ShapePoint> points;
  std::optional<ClosingError> closing{};
  std::vector<view::WeakPlace> weak_places;
};

// Makes one of a route's segments, from the first on, in memory that does not grow with the route.
class ShapeMaker {
 public:
  static constexpr std::size_t kMostCells = 1024;
  static constexpr std::size_t kMostPoints = 2048;
  static constexpr std::size_t kMostWeakPlaces = 256;

  // `width_px`: of the scout's pictures.
  explicit ShapeMaker(int width_px) : weak_places_(width_px) {}

  void Add(const route::Segment& segment);
  [[nodiscard]] RouteShape Shape() const;

 private:
  void AddCell(const route::Segment& segment, double extent);
  void Drive(const route::Segment& segment);
  void AddPoint();
  [[nodiscard]] bool EndsWhereItBegan() const;

  RouteShape shape_;
  ShapePoint at_;
  double heading_rad_ = 0.0;
  double spacing_m_ = 0.02;  // at least, between points; doubles when there are too many
  std::uint32_t in_last_cell_ = 0;
  // Of the route's ends, as far as anything was seen there.
  route::Segment first_;
  route::View last_view_;
  view::WeakPlaceFinder weak_places_;
};

// The error of a loop spread along it: its last point becomes its first, and its heading there what
// it was.
[[nodiscard]] std::vector<ShapePoint> Close(std::vector<ShapePoint> points, double turn_rad);

// As openapi.yaml's RouteShape.
[[nodiscard]] std::string ShapeBody(const route::RouteKey& key, const RouteShape& shape);

}  // namespace trailcast::console
