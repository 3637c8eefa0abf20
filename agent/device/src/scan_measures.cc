#include "agent/device/src/scan_measures.h"

#include <cmath>

#include "services/base/time.h"

namespace trailcast::agent {

double Coming::rate_hz() const {
  return count_ > 1 && last_ > first_ ? (count_ - 1) / Seconds(last_ - first_) : 0.0;
}

ScanMeasures MeasureScan(const motion::Scan& scan, const ObstacleOptions& robot) {
  const double half_m = robot.robot_width_m / 2.0;
  const double front_m = OutlineOf(robot).front_m;
  ScanMeasures measures;
  measures.ranges = static_cast<int>(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = motion::Measured(scan, scan.ranges_m[i]);
    if (!range_m) continue;
    ++measures.seen;
    const double angle_rad = scan.first_rad + static_cast<double>(i) * scan.step_rad;
    const Eigen::Vector2d at(robot.scan_ahead_m + *range_m * std::cos(angle_rad),
                             *range_m * std::sin(angle_rad));
    const bool within = at.x() < front_m && at.x() > -half_m && std::abs(at.y()) < half_m;
    if (within && measures.within_robot++ == 0) measures.first_within = at;
  }
  return measures;
}

}  // namespace trailcast::agent
