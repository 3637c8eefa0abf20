#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "services/route/route.h"

namespace trailcast::junctions {

// A route's path by its odometry, which begins at the origin and heads along x.
class TaughtPath {
 public:
  struct Pose {
    double along_m = 0.0;
    double x_m = 0.0;
    double y_m = 0.0;
    double heading_rad = 0.0;
  };

  explicit TaughtPath(std::span<const route::Segment> segments);
  // `along_m` is clamped to the path.
  [[nodiscard]] Pose At(double along_m) const;
  [[nodiscard]] double length_m() const { return poses_.back().along_m; }

 private:
  std::vector<Pose> poses_;
};

// Measures how far one path lies beside another. It aligns them by their motion around the place,
// so that drift from further away does not count.
class PathsAside {
 public:
  // Returns where on the second path a place on the first is, if it is on it.
  using OnSecond = std::function<std::optional<double>(double along_m)>;
  PathsAside(TaughtPath first, TaughtPath second, OnSecond on_second)
      : first_(std::move(first)), second_(std::move(second)), on_second_(std::move(on_second)) {}

  // Returns metres to the left of the first path, or nothing if both go on together too briefly.
  [[nodiscard]] std::optional<double> At(double along_m, double within_m) const;

 private:
  TaughtPath first_;
  TaughtPath second_;
  OnSecond on_second_;
};

}  // namespace trailcast::junctions
