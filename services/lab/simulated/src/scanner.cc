#include "services/lab/simulated/scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include "services/base/number.h"

namespace trailcast::agent {
namespace {

// These are the values of a small robot's scanner.
constexpr int kRanges = 360;
constexpr double kLeast_m = 0.12;
constexpr double kMost_m = 8.0;
// These are the values of a cheap sonar.
constexpr double kSonar_rad = 0.5;
constexpr int kSonarRays = 15;
constexpr double kNearestSonar_m = 0.02;
constexpr double kFurthestSonar_m = 4.0;

std::optional<double> Metres(std::string_view text) {
  const auto value = ParseNumber<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<Pillar> PillarOf(std::string_view text) {
  const std::size_t first = text.find(',');
  const std::size_t second = text.find(',', first + 1);
  const std::size_t when = text.find('@');
  if (second == std::string_view::npos || when == std::string_view::npos || when < second) {
    return std::nullopt;
  }
  const auto x_m = Metres(text.substr(0, first));
  const auto y_m = Metres(text.substr(first + 1, second - first - 1));
  const auto radius_m = Metres(text.substr(second + 1, when - second - 1));
  const auto spell = ParseSpell(text.substr(when + 1));
  if (!x_m || !y_m || !radius_m || *radius_m <= 0.0 || !spell) return std::nullopt;
  return Pillar{{*x_m, *y_m}, *radius_m, *spell};
}

// Returns the distance along a ray from `from`, with `direction` of length 1, or infinity if it
// misses.
double DistanceTo(const Pillar& pillar, const Eigen::Vector2d& from,
                  const Eigen::Vector2d& direction) {
  const Eigen::Vector2d to = pillar.at - from;
  const double along_m = to.dot(direction);
  const double beside2 = to.squaredNorm() - along_m * along_m;
  const double half2 = pillar.radius_m * pillar.radius_m - beside2;
  if (half2 < 0.0 || along_m + std::sqrt(half2) < 0.0) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(0.0, along_m - std::sqrt(half2));
}

// Returns the range in the sensor's plane, at an angle to the left of its axis, or infinity if
// there is nothing.
double Range(const sim::World& world, const sim::Stage& stage,
             const Eigen::Isometry3d& world_from_sensor, double angle_rad, double most_m,
             const std::vector<Pillar>& pillars) {
  const Eigen::Vector3d from = world_from_sensor.translation();
  const Eigen::Vector3d direction =
      world_from_sensor.linear() * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  double range_m = std::numeric_limits<double>::infinity();
  const auto hit = world.CastRay(from.cast<float>(), direction.cast<float>(), most_m);
  if (hit) range_m = hit->distance_m;
  const auto met = stage.CastRay(from.cast<float>(), direction.cast<float>(), most_m);
  if (met) range_m = std::min(range_m, met->distance_m);
  for (const Pillar& pillar : pillars) {
    range_m = std::min(range_m, DistanceTo(pillar, from.head<2>(), direction.head<2>()));
  }
  return range_m;
}

}  // namespace

Result<Pillar> ParsePillar(const std::string& text) {
  if (const auto pillar = PillarOf(text)) return *pillar;
  return Fail(
      ErrorCode::kInvalidArgument,
      "'{}' is no obstacle: expected X,Y,RADIUS@S in metres and seconds after the robot was "
      "first told to drive, and +S where it is gone after so many seconds, as "
      "3,1.5,0.2@0+10",
      text);
}

motion::Scan LookAround(const sim::World& world, const sim::Stage& stage,
                        const Eigen::Isometry3d& world_from_scanner,
                        const std::vector<Pillar>& pillars) {
  motion::Scan scan{-std::numbers::pi, 2.0 * std::numbers::pi / kRanges, kLeast_m, kMost_m, {}};
  for (int i = 0; i < kRanges; ++i) {
    const double range_m = Range(world, stage, world_from_scanner,
                                 scan.first_rad + i * scan.step_rad, kMost_m, pillars);
    scan.ranges_m.push_back(static_cast<float>(range_m));
  }
  return scan;
}

motion::ConeRange LookAhead(const sim::World& world, const sim::Stage& stage,
                            const Eigen::Isometry3d& world_from_sensor,
                            const std::vector<Pillar>& pillars) {
  double nearest_m = kFurthestSonar_m;
  for (int i = 0; i < kSonarRays; ++i) {
    const double angle_rad = kSonar_rad * (static_cast<double>(i) / (kSonarRays - 1) - 0.5);
    nearest_m = std::min(
        nearest_m, Range(world, stage, world_from_sensor, angle_rad, kFurthestSonar_m, pillars));
  }
  const bool there = nearest_m < kFurthestSonar_m;
  return {kSonar_rad, kNearestSonar_m, kFurthestSonar_m,
          there ? static_cast<float>(nearest_m) : std::numeric_limits<float>::infinity()};
}

}  // namespace trailcast::agent
