#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "services/base/time.h"
#include "services/motion/imu.h"

namespace trailcast::agent {

// Simulates an IMU on the ground below a body's middle, without noise, from the body's places step
// by step.
class BodyImu {
 public:
  // In `world_from_body`, x is ahead, y left and z up. The body stands during the first two steps.
  [[nodiscard]] motion::ImuSample Feel(SensorTime stamp, const Eigen::Isometry3d& world_from_body);

 private:
  struct Step {
    SensorTime stamp{};
    Eigen::Vector3d at_m = Eigen::Vector3d::Zero();
  };
  std::optional<Step> last_;
  std::optional<Eigen::Vector3d> velocity_mps_;
};

}  // namespace trailcast::agent
