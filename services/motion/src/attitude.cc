#include "services/motion/attitude.h"

#include <cmath>

namespace trailcast::motion {

std::optional<double> Heading(const Attitude& attitude) {
  const auto& [x, y, z, w] = attitude;
  const double squared = x * x + y * y + z * z + w * w;
  if (!std::isfinite(squared) || squared < 1e-6) return std::nullopt;
  return std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
}

}  // namespace trailcast::motion
