#pragma once

#include <optional>
#include <vector>

#include "services/motion/imu.h"
#include "services/teach/driven_window.h"

namespace trailcast::teach {

// This measures how steep and how rough the ground is, by an IMU. The length of the acceleration is
// that of gravity, except for what shakes the robot up and down, so for roughness the IMU's mount
// does not matter. For the slope it does: an IMU that is tilted up reports so much more uphill.
class GroundFeel {
 public:
  // Adds the IMU's samples since the last call, which cover the last `dt_s`. They count for the
  // segment if the robot `drives`.
  void Add(const std::vector<motion::ImuSample>& samples, double dt_s, bool drives);

  // Returns the RMS about the mean. Returns nothing without an accelerometer, or if the robot drove
  // too little.
  [[nodiscard]] std::optional<double> vertical_mps2() const;
  // Returns the mean, uphill positive. It is by the attitude or, if the IMU has none, by the mean
  // acceleration, to which a robot that accelerates at 0.1 m/s2 over the whole segment adds 0.6
  // degrees.
  [[nodiscard]] std::optional<double> slope_rad() const;
  void EndSegment();

 private:
  DrivenWindow weight_;  // length of the acceleration, m/s2
  DrivenWindow climb_;
  DrivenWindow ahead_;
  DrivenWindow up_;
};

}  // namespace trailcast::teach
