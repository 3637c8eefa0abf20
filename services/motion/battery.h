#pragma once

#include <cstdint>
#include <optional>

namespace trailcast::motion {

// How full a battery is, of what sensor_msgs/BatteryState says: its percentage is a share of 1, NaN
// where it is not measured. Some drivers say 0 to 100 by mistake: whoever once says more than a
// share can be means that from then on.
class BatteryGauge {
 public:
  // In percent. `percentage` as it was said; of what is none that, `charge_ah` of `capacity_ah` is
  // taken, either of which may be NaN. Nothing: not known.
  [[nodiscard]] std::optional<std::uint8_t> Read(float percentage, float charge_ah,
                                                 float capacity_ah);

 private:
  bool says_percent_ = false;
};

}  // namespace trailcast::motion
