#include "services/console/src/shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/base/angles.h"
#include "services/route/heading.h"
#include "services/view/key_views.h"
#include "services/view/view_match.h"

namespace trailcast::console {
namespace {

constexpr double kStep_m = 0.05;
constexpr double kStep_rad = 0.05;
constexpr double kMostSteps = 256.0;  // in a segment
// A shorter route looks much the same at both ends, and so does a straight corridor.
constexpr double kShortestLoop_m = 5.0;
constexpr double kWidestGap = 0.5;  // of the loop's length

void TakeUp(const ShapeCell& next, ShapeCell& cell) {
  const double before = cell.end - cell.begin;
  const double length = next.end - next.begin;
  if (cell.slope_rad && next.slope_rad && before + length > 0.0) {
    *cell.slope_rad += (*next.slope_rad - *cell.slope_rad) * length / (before + length);
  } else if (next.slope_rad) {
    cell.slope_rad = next.slope_rad;
  }
  cell.roughness = std::max(cell.roughness, next.roughness);
  cell.features += next.features;
  cell.end = next.end;
}

void MergePairs(std::vector<ShapeCell>& cells) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cells.size(); i += 2) {
    ShapeCell cell = cells[i];
    if (i + 1 < cells.size()) TakeUp(cells[i + 1], cell);
    cells[kept++] = cell;
  }
  cells.resize(kept);
}

void KeepEverySecond(std::vector<ShapePoint>& points) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); i += 2) points[kept++] = points[i];
  points.resize(kept);
}

}  // namespace

void ShapeMaker::Add(const route::Segment& segment) {
  const double extent = segment.extent();
  if (shape_.segments == 0) {
    shape_.has_odometry = segment.has_odometry;
    if (segment.has_odometry) shape_.points.push_back(at_);
  }
  std::vector<route::KeyView> views = view::ScoutViewsOf(segment);
  if (!views.empty()) {
    last_view_ = views.back().features;
    if (first_.key_views.empty()) first_.key_views = std::move(views);
  }
  weak_places_.Add(segment);
  AddCell(segment, extent);
  if (segment.has_odometry) Drive(segment);
  shape_.length += extent;
  ++shape_.segments;
}

void ShapeMaker::AddCell(const route::Segment& segment, double extent) {
  const ShapeCell next{.begin = shape_.length,
                       .end = shape_.length + extent,
                       .features = static_cast<std::uint32_t>(segment.features.size()),
                       .roughness = route::RoughnessOf(segment.terrain),
                       .slope_rad = segment.terrain.slope_rad};
  std::vector<ShapeCell>& cells = shape_.cells;
  if (!cells.empty() && in_last_cell_ < shape_.segments_a_cell) {
    TakeUp(next, cells.back());
    ++in_last_cell_;
    return;
  }
  if (cells.size() == kMostCells) {
    MergePairs(cells);
    shape_.segments_a_cell *= 2;
  }
  cells.push_back(next);
  in_last_cell_ = 1;
}

void ShapeMaker::Drive(const route::Segment& segment) {
  heading_rad_ += segment.turn_before_rad;
  const double length_m = segment.length_m;
  const double steps =
      std::clamp(std::ceil(std::max(length_m / kStep_m, segment.heading_variation_rad / kStep_rad)),
                 1.0, kMostSteps);
  const double step_m = length_m / steps;
  const double way_m = segment.reverse ? -step_m : step_m;
  // The polynomial is a fit. Its error is spread so that the heading ends as measured.
  const double missed_rad =
      segment.heading_change_rad - route::HeadingAt(segment.heading, length_m);
  for (double step = 0.0; step < steps; ++step) {
    const double middle_m = (step + 0.5) * step_m;
    const double turned_rad =
        route::HeadingAt(segment.heading, middle_m) + missed_rad * (step + 0.5) / steps;
    const double heading_rad = heading_rad_ + (std::isfinite(turned_rad) ? turned_rad : 0.0);
    at_.x_m += way_m * std::cos(heading_rad);
    at_.y_m += way_m * std::sin(heading_rad);
    at_.along = shape_.length + (step + 1.0) * step_m;
    AddPoint();
  }
  heading_rad_ = WrapAngle(heading_rad_ + segment.heading_change_rad);
}

void ShapeMaker::AddPoint() {
  std::vector<ShapePoint>& points = shape_.points;
  if (!points.empty() && at_.along < points.back().along + spacing_m_) return;
  if (points.size() >= kMostPoints) {
    KeepEverySecond(points);
    spacing_m_ = 2.0 * std::max(spacing_m_, at_.along / kMostPoints);
  }
  points.push_back(at_);
}

bool ShapeMaker::EndsWhereItBegan() const {
  if (!shape_.has_odometry || shape_.length < kShortestLoop_m) return false;
  if (std::hypot(at_.x_m, at_.y_m) > kWidestGap * shape_.length) return false;
  return view::Match(last_view_, first_).found();
}

RouteShape ShapeMaker::Shape() const {
  RouteShape shape = shape_;
  shape.weak_places = weak_places_.Places();
  if (shape.weak_places.size() > kMostWeakPlaces) shape.weak_places.resize(kMostWeakPlaces);
  if (!shape.points.empty() && shape.points.back().along < at_.along) shape.points.push_back(at_);
  if (EndsWhereItBegan()) {
    shape.closing = {std::hypot(at_.x_m, at_.y_m), WrapAngle(heading_rad_)};
    shape.points = Close(std::move(shape.points), shape.closing->turn_rad);
  }
  return shape;
}

std::vector<ShapePoint> Close(std::vector<ShapePoint> points, double turn_rad) {
  if (points.empty() || points.back().along <= points.front().along) return points;
  const double begin = points.front().along;
  const double length = points.back().along - begin;
  // Each step is first turned back by its share, and then shifted.
  ShapePoint before = points.front();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double middle = 0.5 * (before.along + points[i].along);
    const double back_rad = -turn_rad * (middle - begin) / length;
    const double x_m = points[i].x_m - before.x_m;
    const double y_m = points[i].y_m - before.y_m;
    before = points[i];
    points[i].x_m = points[i - 1].x_m + std::cos(back_rad) * x_m - std::sin(back_rad) * y_m;
    points[i].y_m = points[i - 1].y_m + std::sin(back_rad) * x_m + std::cos(back_rad) * y_m;
  }
  const double gap_x_m = points.back().x_m - points.front().x_m;
  const double gap_y_m = points.back().y_m - points.front().y_m;
  for (ShapePoint& point : points) {
    point.x_m -= gap_x_m * (point.along - begin) / length;
    point.y_m -= gap_y_m * (point.along - begin) / length;
  }
  return points;
}

}  // namespace trailcast::console
