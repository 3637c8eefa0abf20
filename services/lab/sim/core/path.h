#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "services/base/result.h"
#include "services/motion/motion.h"

namespace trailcast::sim {

// Way-points on the world's level plane, metres.
using Polyline = std::vector<Eigen::Vector2d>;

enum class Gear { kForwards, kBackwards };

struct DrivenPath {
  Polyline points;  // at least two, no two neighbours the same
  // If this is given, the robot starts on the highest surface below it.
  std::optional<double> z_max_m;
  // Where the points double back, the robot turns on the spot. If this is given, it instead changes
  // between driving forwards and backwards, beginning with this gear.
  std::optional<Gear> shunts_from = std::nullopt;
};

// The driven curve is held in memory in steps of centimetres, so its length is limited to ten
// kilometres.
inline constexpr double kLongestPath_m = 10'000.0;

// Reads `x_m,y_m[,z_m]` with that header line and at least two rows, and a path of at most
// kLongestPath_m. Errors name file and line.
[[nodiscard]] Result<DrivenPath> ReadPath(const std::filesystem::path& file);

// Returns the pose at the first way-point, heading for the second. `points` has at least two.
[[nodiscard]] motion::Pose2 StartPose(const Polyline& points);
// Returns the same pose, with its back to the second way-point if it begins backwards.
[[nodiscard]] motion::Pose2 StartPose(const DrivenPath& path);
[[nodiscard]] double Length(const Polyline& points);
// Returns the corners replaced by arcs of about `radius_m` (smaller if a leg is short), sampled
// every `spacing_m`. The ends stay.
[[nodiscard]] Polyline RoundCorners(const Polyline& points, double radius_m, double spacing_m);

struct PlaceOnPath {
  double distance_m = 0.0;  // off the path
  double along_m = 0.0;     // from its beginning
  double left_m = 0.0;      // the same distance, signed: above 0 to the left of the path
};
// Returns the nearest place on a poly-line of at least two points, between the two distances along
// it.
[[nodiscard]] PlaceOnPath Nearest(const Polyline& points, const Eigen::Vector2d& place,
                                  double from_along_m = 0.0, double to_along_m = 1e18);
// Returns the point that far along, clamped to the ends.
[[nodiscard]] Eigen::Vector2d PointAlong(const Polyline& points, double along_m);
// Returns the pose there, heading from `about_m` before it to `about_m` after it.
[[nodiscard]] motion::Pose2 PoseAlong(const Polyline& points, double along_m, double about_m);

}  // namespace trailcast::sim
