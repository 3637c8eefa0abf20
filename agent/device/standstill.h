#pragma once

#include "agent/device/device.h"

namespace trailcast::agent {

// Commands the robot to stand when it goes, however the loop around it ends.
class Standstill {
 public:
  explicit Standstill(RobotDevice& device) : device_(device) {}
  ~Standstill() {
    if (!left_) Stop();
  }
  Standstill(const Standstill&) = delete;
  Standstill& operator=(const Standstill&) = delete;

  // Somebody else sees to that from now on.
  void Leave() { left_ = true; }

  // A base that cannot even be told to stand is the base's own watchdog's matter.
  void Stop() const { [[maybe_unused]] const auto told = device_.Drive({0.0, 0.0}); }

 private:
  RobotDevice& device_;
  bool left_ = false;
};

}  // namespace trailcast::agent
