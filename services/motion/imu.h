#pragma once

#include <Eigen/Core>
#include <optional>

#include "services/motion/attitude.h"

namespace trailcast::motion {

// What an inertial measurement unit says at one moment, mounted as the base is (REP 103: x ahead,
// y left, z up) or said in the base's frame.
struct ImuSample {
  // REP 145: of a base that stands level, +9.81 along z. Nothing: it has no accelerometer.
  std::optional<Eigen::Vector3d> acceleration_mps2{};
  // Against the horizon. Nothing: it does not tell.
  std::optional<Attitude> attitude{};
};

// How far x points above the horizon: the slope of the way that a base drives ahead, uphill
// positive. Nothing for numbers that are none, or a quaternion of length 0.
[[nodiscard]] std::optional<double> Climb(const Attitude& attitude);

}  // namespace trailcast::motion
