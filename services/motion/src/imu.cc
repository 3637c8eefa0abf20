#include "services/motion/imu.h"

#include <algorithm>
#include <cmath>

namespace trailcast::motion {

std::optional<double> Climb(const Attitude& attitude) {
  const auto& [x, y, z, w] = attitude;
  const double squared = x * x + y * y + z * z + w * w;
  if (!std::isfinite(squared) || squared < 1e-6) return std::nullopt;
  return std::asin(std::clamp(2.0 * (x * z - w * y) / squared, -1.0, 1.0));
}

}  // namespace trailcast::motion
