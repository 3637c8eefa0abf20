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

// This is a section of a route: one segment or, in a long route, as many successive ones as keep
// the cells few.
struct ShapeCell {
  double begin = 0.0;  // along the route, as its end
  double end = 0.0;
  std::uint32_t features = 0;                   // of all its segments
  std::optional<route::Roughness> roughness{};  // the roughest in it
  std::optional<double> slope_rad{};            // the mean, uphill positive

  [[nodiscard]] double features_per_unit() const {
    return end > begin ? features / (end - begin) : 0.0;
  }
};

// This is in metres, with the route's beginning at the origin and its heading along x; y is to the
// left.
struct ShapePoint {
  double along = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
};

// For a route that ends where it began, this is how far its end is from its beginning by odometry.
struct ClosingError {
  double gap_m = 0.0;
  double turn_rad = 0.0;  // the end's heading less the beginning's, -pi to pi
};

// This is a taught route as it is drawn. Places along it are in metres or, if it was taught without
// odometry, in seconds of teaching in motion.
struct RouteShape {
  bool has_odometry = false;
  double length = 0.0;
  std::uint32_t segments = 0;
  std::uint32_t segments_a_cell = 1;
  std::vector<ShapeCell> cells;
  // These are by the scout's odometry, which drifts, so they are no map. A loop is closed, for
  // drawing alone. There are none without odometry.
  std::vector<ShapePoint> points;
  std::optional<ClosingError> closing{};
  std::vector<view::WeakPlace> weak_places;
};

// This makes a shape of a route's segments, from the first on, in memory that does not grow with
// the route.
class ShapeMaker {
 public:
  static constexpr std::size_t kMostCells = 1024;
  static constexpr std::size_t kMostPoints = 2048;
  static constexpr std::size_t kMostWeakPlaces = 256;

  // `width_px` is the width of the scout's pictures.
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
  double spacing_m_ = 0.02;  // least distance of points; doubles when there are too many
  std::uint32_t in_last_cell_ = 0;
  // These are of the route's ends, as far as anything was seen there.
  route::Segment first_;
  route::View last_view_;
  view::WeakPlaceFinder weak_places_;
};

// Returns the points with a loop's error spread along it: the last point becomes the first, and the
// heading there what it was.
[[nodiscard]] std::vector<ShapePoint> Close(std::vector<ShapePoint> points, double turn_rad);

// Returns openapi.yaml's RouteShape.
[[nodiscard]] std::string ShapeBody(const route::RouteKey& key, const RouteShape& shape);

}  // namespace trailcast::console
