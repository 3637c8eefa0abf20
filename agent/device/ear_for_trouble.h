#pragma once

#include "agent/device/device.h"

namespace trailcast::agent {

// Listens to a robot's trouble for its own lifetime. A device has one at a time.
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
