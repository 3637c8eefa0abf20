#include "services/motion/attitude.h"

#include <fmt/format.h>

#include <cmath>

namespace trailcast::motion {

std::optional<double> Heading(const Attitude& attitude) {
  const auto& [x, y, z, w] = attitude;
  const double squared = x * x + y * y + z * z + w * w;
  if (!std::isfinite(squared) || squared < 1e-6) return std::nullopt;
  return std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
}

std::string WithoutHeading(const Attitude& attitude) {
  return fmt::format(
      "the orientation in it is the quaternion ({:g}, {:g}, {:g}, {:g}), which is none: its driver "
      "has to fill it in",
      attitude.x, attitude.y, attitude.z, attitude.w);
}

}  // namespace trailcast::motion
