#pragma once

#include "agent/device/device.h"

namespace trailcast::agent {

// Stops the robot in its destructor, however the loop around it ends.
class Standstill {
 public:
  explicit Standstill(RobotDevice& device) : device_(device) {}
  ~Standstill() {
    if (!left_) Stop();
  }
  Standstill(const Standstill&) = delete;
  Standstill& operator=(const Standstill&) = delete;

  // Leaves the stop to somebody else.
  void Leave() { left_ = true; }

  // If the base cannot even be told to stop, its own watchdog has to.
  void Stop() const { [[maybe_unused]] const auto told = device_.Drive({0.0, 0.0}); }

 private:
  RobotDevice& device_;
  bool left_ = false;
};

}  // namespace trailcast::agent
