#include "services/motion/scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trailcast::motion {
namespace {

constexpr double kMostAngle_rad = 4.0 * std::numbers::pi;

}  // namespace

bool Plausible(const Scan& scan) {
  if (scan.ranges_m.empty() || scan.ranges_m.size() > kMostRanges) return false;
  if (!(std::abs(scan.first_rad) <= kMostAngle_rad) || !std::isfinite(scan.step_rad)) return false;
  const double turned_rad = std::abs(scan.step_rad) * static_cast<double>(scan.ranges_m.size() - 1);
  return scan.step_rad != 0.0 && turned_rad <= kMostAngle_rad && std::isfinite(scan.least_m) &&
         scan.least_m >= 0.0 && scan.most_m > scan.least_m;
}

std::optional<double> Measured(const Scan& scan, float range_m) {
  if (std::isinf(range_m) && range_m < 0.0F) return scan.least_m;
  const bool there =
      std::isfinite(range_m) && range_m > 0.0F && range_m >= scan.least_m && range_m <= scan.most_m;
  return there ? std::optional<double>(range_m) : std::nullopt;
}

bool LooksTo(const Scan& scan, double angle_rad) {
  const double last_rad =
      scan.first_rad + scan.step_rad * static_cast<double>(scan.ranges_m.size() - 1);
  const double low_rad = std::min(scan.first_rad, last_rad);
  // A scanner that looks all round leaves out at most one step.
  const double turned_rad = std::abs(last_rad - scan.first_rad) + std::abs(scan.step_rad);
  const double off_rad = std::remainder(angle_rad - low_rad, 2.0 * std::numbers::pi);
  return (off_rad < 0.0 ? off_rad + 2.0 * std::numbers::pi : off_rad) <= turned_rad;
}

}  // namespace trailcast::motion
