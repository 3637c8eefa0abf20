#include "services/motion/cone_range.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trailcast::motion {

bool Plausible(const ConeRange& range) {
  return range.field_rad >= 0.0 && range.field_rad <= std::numbers::pi && range.least_m >= 0.0 &&
         std::isfinite(range.least_m) && range.most_m >= range.least_m;
}

std::vector<Eigen::Vector2d> Points(const ConeRange& range, const Pose2& axle_from_sensor) {
  const bool too_near = std::isinf(range.range_m) && range.range_m < 0.0F;
  const double range_m = too_near ? range.least_m : range.range_m;
  const bool measured =
      std::isfinite(range_m) && range_m > 0.0 && range_m >= range.least_m && range_m < range.most_m;
  if (!too_near && !measured) return {};
  constexpr double kMostPoints = 64.0;
  const int steps =
      static_cast<int>(std::min(kMostPoints, std::ceil(range.field_rad * range_m / kArc_m)));
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= steps; ++i) {
    const double share = steps == 0 ? 0.0 : static_cast<double>(i) / steps - 0.5;
    const double angle_rad = share * range.field_rad;
    points.push_back(Position(Compose(
        axle_from_sensor, {range_m * std::cos(angle_rad), range_m * std::sin(angle_rad), 0.0})));
  }
  return points;
}

}  // namespace trailcast::motion
