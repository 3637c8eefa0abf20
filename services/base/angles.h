#pragma once

#include <cmath>
#include <numbers>

namespace trailcast {

[[nodiscard]] constexpr double Radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}
[[nodiscard]] constexpr double Degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

// Returns the same direction in (-pi, pi].
[[nodiscard]] inline double WrapAngle(double radians) {
  const double wrapped = std::remainder(radians, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2.0 * std::numbers::pi : wrapped;
}

}  // namespace trailcast
