#pragma once

#include <optional>
#include <string>

#include "agent/device/device.h"
#include "agent/device/standstill.h"
#include "services/base/result.h"
#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Turns a robot on the spot, by what its wheels say. It stands when this goes.
class Turning {
 public:
  // `turned_rad`: so far to the left it is turned already.
  Turning(RobotDevice& device, double turned_rad)
      : device_(device), standstill_(device), turned_rad_(turned_rad) {}

  // Waits for a frame, and turns on to where it is turned by so much to the left. True: it is
  // there, and stands. kUnavailable: it has no odometry, it does not turn, or what it sees has
  // ended.
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
