#include "services/motion/drive_limits.h"

#include <algorithm>
#include <cmath>

namespace trailcast::motion {
namespace {

constexpr double kWheel_m = 0.2;  // from the base's middle

// Returns the share of `value` that is within `most`.
double ShareWithin(double value, double most) {
  return std::abs(value) > most ? most / std::abs(value) : 1.0;
}

// Returns the highest speed after a change of `change`: a base that reverses stops first.
double Reach(double value, double now, double change) {
  return (value * now > 0.0 ? std::abs(now) : 0.0) + change;
}

}  // namespace

VelocityCommand Shape(const VelocityCommand& wanted, const VelocityCommand& now, double dt_s,
                      const DriveLimits& limits) {
  VelocityCommand shaped = wanted;
  const auto scale = [&](double share) {
    shaped.linear_mps *= share;
    shaped.angular_radps *= share;
  };
  if (limits.turn_radius_m > 0.0) {
    const double most = std::abs(shaped.linear_mps) / limits.turn_radius_m;
    shaped.angular_radps = std::clamp(shaped.angular_radps, -most, most);
  }
  scale(std::min(ShareWithin(shaped.linear_mps, limits.speed_mps),
                 ShareWithin(shaped.angular_radps, limits.turn_rate_radps)));
  const double change_mps = limits.acceleration_mps2 * dt_s;
  if (shaped.linear_mps != 0.0) {
    scale(ShareWithin(shaped.linear_mps, Reach(shaped.linear_mps, now.linear_mps, change_mps)));
  } else {
    scale(ShareWithin(shaped.angular_radps,
                      Reach(shaped.angular_radps, now.angular_radps, change_mps / kWheel_m)));
  }
  return shaped;
}

}  // namespace trailcast::motion
