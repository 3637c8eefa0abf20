#pragma once

#include <Eigen/Core>
#include <optional>

#include "services/motion/attitude.h"

namespace trailcast::motion {

// The readings of an inertial measurement unit at one moment, in the base's frame (REP 103: x
// ahead, y left, z up).
struct ImuSample {
  // A level base at rest has +9.81 along z (REP 145). A unit without an accelerometer gives
  // nothing.
  std::optional<Eigen::Vector3d> acceleration_mps2{};
  // The attitude against the horizon, if the unit gives one.
  std::optional<Attitude> attitude{};
};

// Returns how far x points above the horizon: the slope of the ground ahead, uphill positive.
// Numbers that are not finite and a quaternion of length 0 have none.
[[nodiscard]] std::optional<double> Climb(const Attitude& attitude);

}  // namespace trailcast::motion
