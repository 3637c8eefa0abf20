#pragma once

#include "agent/device/device.h"

namespace trailcast::agent {

// Listens to a robot's trouble for its own lifetime. A device has one at a time.
class FaultSubscription {
 public:
  FaultSubscription(RobotDevice& device, const RobotDevice::Trouble& hear) : device_(device) {
    device_.OnTrouble(hear);
  }
  ~FaultSubscription() {
    device_.OnTrouble([](const RobotDevice::Halt&) {});
  }
  FaultSubscription(const FaultSubscription&) = delete;
  FaultSubscription& operator=(const FaultSubscription&) = delete;

 private:
  RobotDevice& device_;
};

}  // namespace trailcast::agent
