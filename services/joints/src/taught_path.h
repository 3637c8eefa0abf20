#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "services/route/route.h"

namespace trailcast::joints {

// A route's path by its odometry, from its beginning at the origin, heading along x.
class TaughtPath {
 public:
  struct Pose {
    double along_m = 0.0;
    double x_m = 0.0;
    double y_m = 0.0;
    double heading_rad = 0.0;
  };

  explicit TaughtPath(std::span<const route::Segment> segments);
  // Between its beginning and its end.
  [[nodiscard]] Pose At(double along_m) const;
  [[nodiscard]] double length_m() const { return poses_.back().along_m; }

 private:
  std::vector<Pose> poses_;
};

// How far one path lies beside another, near by: the one is laid upon the other by what both do
// around the place, so that neither's drift from further off counts.
class PathsAside {
 public:
  // Where on the second a place on the first is, if it is on it.
  using OnSecond = std::function<std::optional<double>(double along_m)>;
  PathsAside(TaughtPath first, TaughtPath second, OnSecond on_second)
      : first_(std::move(first)), second_(std::move(second)), on_second_(std::move(on_second)) {}

  // To the left of the first, metres; nothing where both go on together for too short a way.
  [[nodiscard]] std::optional<double> At(double along_m, double within_m) const;

 private:
  TaughtPath first_;
  TaughtPath second_;
  OnSecond on_second_;
};

}  // namespace trailcast::joints
