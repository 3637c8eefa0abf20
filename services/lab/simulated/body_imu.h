#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "services/base/time.h"
#include "services/motion/imu.h"

namespace trailcast::agent {

// What an IMU on the ground below a body's middle says, with no noise of its own, by where the body
// is from step to step.
class BodyImu {
 public:
  // `world_from_body`: x ahead, y left, z up. Of the first two steps it stands.
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
