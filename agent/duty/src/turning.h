#pragma once

#include <optional>
#include <string>

#include "agent/device/device.h"
#include "agent/device/standstill.h"
#include "services/base/result.h"
#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Turns a robot on the spot, by its odometry. The destructor stops it.
class Turning {
 public:
  // `turned_rad` is how far it has already turned to the left.
  Turning(RobotDevice& device, double turned_rad)
      : device_(device), standstill_(device), turned_rad_(turned_rad) {}

  // Waits for a frame, and turns on towards so far to the left. Returns true once the robot is
  // there and stands. kUnavailable means that it has no odometry, does not turn, or gives no more
  // frames.
  [[nodiscard]] Result<bool> TurnOnTo(double to_rad);
  [[nodiscard]] double turned_rad() const { return turned_rad_; }

 private:
  RobotDevice& device_;
  Standstill standstill_;
  double turned_rad_;
  std::optional<motion::Pose2> pose_;  // in the last frame
  std::optional<SensorTime> moved_at_;
};

}  // namespace trailcast::agent
