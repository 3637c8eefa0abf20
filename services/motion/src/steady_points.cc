#include "services/motion/steady_points.h"

#include <algorithm>
#include <cmath>

namespace trailcast::motion {
namespace {

// A point further away than this belongs to another thing.
constexpr double kBeyond_m = 0.3;
// The next scan may have the same thing this far off, because a robot turns and drives between
// scans.
constexpr double kTurned_rad = 0.1;
constexpr double kDriven_m = 0.2;
constexpr double kMostNeighbours = 100.0;

bool IsSingle(const Scan& scan, std::size_t index, double range_m) {
  const auto beyond = [&](std::size_t neighbour) {
    const auto there_m = Measured(scan, scan.ranges_m[neighbour]);
    return !there_m || *there_m > range_m + kBeyond_m;
  };
  const bool has_before = index > 0;
  const bool has_after = index + 1 < scan.ranges_m.size();
  if (!has_before && !has_after) return false;
  return (!has_before || beyond(index - 1)) && (!has_after || beyond(index + 1));
}

}  // namespace

bool SteadyPoints::SeenBefore(double angle_rad, double range_m) const {
  const auto count = std::ssize(before_.ranges_m);
  if (count == 0) return false;
  const double middle = (angle_rad - before_.first_rad) / before_.step_rad;
  // The scan may come from another scanner than the one before.
  if (!(std::abs(middle) < 2.0 * static_cast<double>(kMostRanges))) return false;
  const double wide = std::clamp(kTurned_rad / std::abs(before_.step_rad), 1.0, kMostNeighbours);
  const long reach = std::min<long>(std::lround(wide), count);
  for (long i = std::lround(middle) - reach; i <= std::lround(middle) + reach; ++i) {
    const auto index = static_cast<std::size_t>((i % count + count) % count);  // all round
    const auto there_m = Measured(before_, before_.ranges_m[index]);
    if (there_m && std::abs(*there_m - range_m) <= kDriven_m) return true;
  }
  return false;
}

std::vector<Eigen::Vector2d> SteadyPoints::Next(const Scan& scan, double ahead_m) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = Measured(scan, scan.ranges_m[i]);
    if (!range_m) continue;
    const double angle_rad = scan.first_rad + static_cast<double>(i) * scan.step_rad;
    if (IsSingle(scan, i, *range_m) && !SeenBefore(angle_rad, *range_m)) continue;
    points.emplace_back(ahead_m + *range_m * std::cos(angle_rad), *range_m * std::sin(angle_rad));
  }
  before_ = scan;
  return points;
}

}  // namespace trailcast::motion
