#include "services/lab/simulated/body_imu.h"

#include <utility>

namespace trailcast::agent {
namespace {

constexpr double kGravity_mps2 = 9.81;

}  // namespace

motion::ImuSample BodyImu::Feel(SensorTime stamp, const Eigen::Isometry3d& world_from_body) {
  const Eigen::Vector3d at_m = world_from_body.translation();
  Eigen::Vector3d acceleration_mps2(0.0, 0.0, kGravity_mps2);
  const auto before = std::exchange(last_, Step{stamp, at_m});
  if (before && stamp > before->stamp) {
    const double dt_s = Seconds(stamp - before->stamp);
    const Eigen::Vector3d velocity_mps = (at_m - before->at_m) / dt_s;
    if (velocity_mps_) acceleration_mps2 += (velocity_mps - *velocity_mps_) / dt_s;
    velocity_mps_ = velocity_mps;
  }
  const Eigen::Quaterniond q(world_from_body.linear());
  motion::ImuSample felt;
  felt.acceleration_mps2 = world_from_body.linear().transpose() * acceleration_mps2;
  felt.attitude = motion::Attitude{q.x(), q.y(), q.z(), q.w()};
  return felt;
}

}  // namespace trailcast::agent
