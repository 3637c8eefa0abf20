#pragma once

#include "agent/device/device.h"

namespace trailcast::agent {

// Hears of a robot's trouble for as long as it is there. A device has one at a time.
class EarForTrouble {
 public:
  EarForTrouble(RobotDevice& device, const RobotDevice::Trouble& hear) : device_(device) {
    device_.OnTrouble(hear);
  }
  ~EarForTrouble() {
    device_.OnTrouble([](const RobotDevice::Halt&) {});
  }
  EarForTrouble(const EarForTrouble&) = delete;
  EarForTrouble& operator=(const EarForTrouble&) = delete;

 private:
  RobotDevice& device_;
};

}  // namespace trailcast::agent
