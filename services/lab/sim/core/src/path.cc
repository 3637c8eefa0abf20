#include "services/lab/sim/core/path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "services/base/angles.h"
#include "services/base/number_table.h"

namespace trailcast::sim {
namespace {

// Appends the arc that replaces `corner`, as a curve of second degree between its two tangents.
void AppendCorner(const Eigen::Vector2d& before, const Eigen::Vector2d& corner,
                  const Eigen::Vector2d& after, double radius_m, Polyline& rounded) {
  const Eigen::Vector2d in = (corner - before).normalized();
  const Eigen::Vector2d out = (after - corner).normalized();
  const double turn_rad = std::acos(std::clamp(in.dot(out), -1.0, 1.0));
  const double room_m = 0.5 * std::min((corner - before).norm(), (after - corner).norm());
  const double cut_m = std::min(radius_m * std::tan(std::min(turn_rad, 3.0) / 2.0), room_m);
  constexpr int kPieces = 24;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = static_cast<double>(i) / kPieces;
    const Eigen::Vector2d a = corner - (1.0 - t) * cut_m * in;
    const Eigen::Vector2d b = corner + t * cut_m * out;
    rounded.push_back((1.0 - t) * a + t * b);
  }
}

}  // namespace

Result<DrivenPath> ReadPath(const std::filesystem::path& file) {
  const auto rows = ReadNumbers(file, {"x_m", "y_m"}, {"z_m"});
  if (!rows) return tl::unexpected(rows.error());
  DrivenPath path;
  for (const auto& [line, row] : *rows) {
    const Eigen::Vector2d point(row[0], row[1]);
    if (path.points.empty() && row.size() == 3) path.z_max_m = row[2];
    if (path.points.empty() || (point - path.points.back()).norm() > 1e-6) {
      path.points.push_back(point);
    }
  }
  if (path.points.size() < 2) {
    return Fail(ErrorCode::kInvalidArgument,
                "{} has {} way-points that differ; expected at least two", file.string(),
                path.points.size());
  }
  if (const double length_m = Length(path.points); !(length_m <= kLongestPath_m)) {
    return Fail(ErrorCode::kInvalidArgument,
                "{}: its way-points make a path of {:.6g} m; expected at most {:.0f} m",
                file.string(), length_m, kLongestPath_m);
  }
  return path;
}

motion::Pose2 StartPose(const Polyline& points) {
  const Eigen::Vector2d ahead = points[1] - points[0];
  return {points[0].x(), points[0].y(), std::atan2(ahead.y(), ahead.x())};
}

motion::Pose2 StartPose(const DrivenPath& path) {
  motion::Pose2 pose = StartPose(path.points);
  if (path.shunts_from == Gear::kBackwards) {
    pose.heading_rad = WrapAngle(pose.heading_rad + Radians(180.0));
  }
  return pose;
}

double Length(const Polyline& points) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length_m += (points[i] - points[i - 1]).norm();
  return length_m;
}

Eigen::Vector2d PointAlong(const Polyline& points, double along_m) {
  double left_m = std::max(0.0, along_m);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double leg_m = (points[i] - points[i - 1]).norm();
    if (left_m <= leg_m && leg_m > 0.0) {
      return points[i - 1] + left_m / leg_m * (points[i] - points[i - 1]);
    }
    left_m -= leg_m;
  }
  return points.back();
}

motion::Pose2 PoseAlong(const Polyline& points, double along_m, double about_m) {
  const Eigen::Vector2d at = PointAlong(points, along_m);
  const Eigen::Vector2d way =
      PointAlong(points, along_m + about_m) - PointAlong(points, along_m - about_m);
  return {at.x(), at.y(), std::atan2(way.y(), way.x())};
}

Polyline RoundCorners(const Polyline& points, double radius_m, double spacing_m) {
  Polyline rounded = {points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    AppendCorner(points[i - 1], points[i], points[i + 1], radius_m, rounded);
  }
  rounded.push_back(points.back());
  const double length_m = Length(rounded);
  const int pieces = std::max(1, static_cast<int>(std::lround(length_m / spacing_m)));
  Polyline sampled;
  sampled.reserve(static_cast<std::size_t>(pieces) + 1);
  for (int i = 0; i <= pieces; ++i) sampled.push_back(PointAlong(rounded, length_m * i / pieces));
  return sampled;
}

PlaceOnPath Nearest(const Polyline& points, const Eigen::Vector2d& place, double from_along_m,
                    double to_along_m) {
  PlaceOnPath nearest;
  nearest.distance_m = std::numeric_limits<double>::infinity();
  double before_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d leg = points[i] - points[i - 1];
    const double leg_m = leg.norm();
    const double low = std::max(0.0, from_along_m - before_m);
    const double high = std::min(leg_m, to_along_m - before_m);
    if (leg_m > 0.0 && low <= high) {
      const Eigen::Vector2d ahead = leg / leg_m;
      const Eigen::Vector2d offset = place - points[i - 1];
      const double along_m = std::clamp(offset.dot(ahead), low, high);
      const double distance_m = (offset - along_m * ahead).norm();
      if (distance_m < nearest.distance_m) {
        const bool left = ahead.x() * offset.y() - ahead.y() * offset.x() >= 0.0;
        nearest = {distance_m, before_m + along_m, left ? distance_m : -distance_m};
      }
    }
    before_m += leg_m;
  }
  return nearest;
}

}  // namespace trailcast::sim
