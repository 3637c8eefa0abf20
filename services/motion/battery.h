#pragma once

#include <cstdint>
#include <optional>

namespace trailcast::motion {

// Reads how full a battery is from sensor_msgs/BatteryState. Its percentage is a share of 1, or NaN
// if it is not measured. Some drivers give 0 to 100 by mistake: once a value is too large for a
// share, all later ones are taken as percents.
class BatteryGauge {
 public:
  // Returns percents, or nothing if they are not known. If `percentage` is NaN, `charge_ah` of
  // `capacity_ah` counts instead, either of which may be NaN too.
  [[nodiscard]] std::optional<std::uint8_t> Read(float percentage, float charge_ah,
                                                 float capacity_ah);

 private:
  bool says_percent_ = false;
};

}  // namespace trailcast::motion
