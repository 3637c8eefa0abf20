#include "services/motion/battery.h"

#include <algorithm>
#include <cmath>

namespace trailcast::motion {
namespace {

// A gauge that reads a little above full still gives shares.
constexpr float kMostShare = 1.5F;
constexpr float kMostPercent = 100.0F * kMostShare;

std::uint8_t Whole(float percent) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(percent, 0.0F, 100.0F)));
}

}  // namespace

std::optional<std::uint8_t> BatteryGauge::Read(float percentage, float charge_ah,
                                               float capacity_ah) {
  if (percentage >= 0.0F && percentage <= kMostPercent) {
    if (percentage > kMostShare) says_percent_ = true;
    return Whole(says_percent_ ? percentage : 100.0F * percentage);
  }
  if (charge_ah >= 0.0F && capacity_ah > 0.0F && std::isfinite(charge_ah / capacity_ah)) {
    return Whole(100.0F * charge_ah / capacity_ah);
  }
  return std::nullopt;
}

}  // namespace trailcast::motion
