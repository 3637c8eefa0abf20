#pragma once

#include <optional>
#include <vector>

#include "services/motion/imu.h"
#include "services/teach/driven_window.h"

namespace trailcast::teach {

// How steep and how rough the ground is, by an IMU. The vertical is where gravity is, whose length
// the acceleration has but for what shakes the robot up and down: how the IMU is mounted does not
// matter for that. For the slope it does: one that is mounted tilted up tells so much more uphill.
class GroundFeel {
 public:
  // What it said since the last call, within the last `dt_s`. `drives`: counts for the segment.
  void Add(const std::vector<motion::ImuSample>& samples, double dt_s, bool drives);

  // RMS, less its mean. Nothing: no accelerometer, or too little was driven.
  [[nodiscard]] std::optional<double> vertical_mps2() const;
  // Mean, uphill positive: by the attitude, or where the IMU does not tell it by the mean
  // acceleration, of which a robot that speeds up over the whole segment by 0.1 m/s2 makes 0.6
  // degrees.
  [[nodiscard]] std::optional<double> slope_rad() const;
  void EndSegment();

 private:
  DrivenWindow weight_;  // what a mass weighs, m/s2
  DrivenWindow climb_;
  DrivenWindow ahead_;
  DrivenWindow up_;
};

}  // namespace trailcast::teach
