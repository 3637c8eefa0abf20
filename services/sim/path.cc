#include "services/sim/path.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>

namespace trailcast::sim {
namespace {

std::string Trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t from = 0;
  while (true) {
    const std::size_t comma = line.find(',', from);
    fields.push_back(Trimmed(line.substr(from, comma - from)));
    if (comma == std::string::npos) return fields;
    from = comma + 1;
  }
}

std::optional<double> ToNumber(const std::string& field) {
  double value = 0.0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<std::size_t> ReadHeader(const std::string& line, const std::string& file) {
  const auto fields = Fields(line);
  const std::vector<std::string> plain = {"x_m", "y_m"};
  const std::vector<std::string> with_z = {"x_m", "y_m", "z_m"};
  if (fields == plain || fields == with_z) return fields.size();
  return Fail(ErrorCode::kInvalidArgument,
              "{} line 1: the header is \"{}\"; expected \"x_m,y_m\" or \"x_m,y_m,z_m\"", file,
              Trimmed(line));
}

Result<std::vector<double>> ReadRow(const std::string& line, std::size_t columns,
                                    const std::string& file, int line_number) {
  const auto fields = Fields(line);
  if (fields.size() != columns) {
    return Fail(ErrorCode::kInvalidArgument, "{} line {}: {} columns; expected {}", file,
                line_number, fields.size(), columns);
  }
  std::vector<double> row;
  row.reserve(columns);
  for (const std::string& field : fields) {
    const auto value = ToNumber(field);
    if (!value) {
      return Fail(ErrorCode::kInvalidArgument, "{} line {}: \"{}\" is no number of metres", file,
                  line_number, field);
    }
    row.push_back(*value);
  }
  return row;
}

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
  std::ifstream stream(file);
  if (!stream) {
    return Fail(ErrorCode::kNotFound, "cannot open the path {}: check that the file exists",
                file.string());
  }
  std::string line;
  std::getline(stream, line);
  const auto columns = ReadHeader(line, file.string());
  if (!columns) return tl::unexpected(columns.error());
  DrivenPath path;
  for (int line_number = 2; std::getline(stream, line); ++line_number) {
    if (Trimmed(line).empty()) continue;
    const auto row = ReadRow(line, *columns, file.string(), line_number);
    if (!row) return tl::unexpected(row.error());
    const Eigen::Vector2d point((*row)[0], (*row)[1]);
    if (path.points.empty() && row->size() == 3) path.z_max_m = (*row)[2];
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
