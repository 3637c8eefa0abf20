#include "services/lab/sim/core/disturbances.h"

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::sim {

Disturbances Disturbances::ForScout() {
  Disturbances scout;
  scout.start_sideways_m = scout.start_along_m = scout.start_heading_rad = 0.0;
  scout.gain_low = scout.gain_high = 1.0;
  return scout;
}

Disturbances Disturbances::None() {
  Disturbances none = ForScout();
  none.odometry_scale = none.heading_bias_rad_per_m = none.wheel_base = none.slip = 0.0;
  none.camera_yaw_rad = none.camera_pitch_rad = none.camera_height_m = 0.0;
  return none;
}

Lighting WithMovedSun(const Lighting& lighting, std::uint64_t seed) {
  Random sky(seed, "sun");
  const double side = sky.Uniform() < 0.5 ? -1.0 : 1.0;
  const double round_rad = side * Radians(15.0 + 30.0 * sky.Uniform());
  const double higher_rad = Radians(20.0 * sky.Uniform() - 10.0);
  const Eigen::Vector3d before = lighting.toward_sun.cast<double>();
  const double azimuth_rad = std::atan2(before.y(), before.x()) + round_rad;
  const double elevation_rad = std::clamp(std::asin(std::clamp(before.z(), -1.0, 1.0)) + higher_rad,
                                          Radians(15.0), Radians(80.0));
  Lighting moved = lighting;
  moved.toward_sun =
      Eigen::Vector3d(std::cos(elevation_rad) * std::cos(azimuth_rad),
                      std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad))
          .cast<float>();
  return moved;
}

RobotErrors DrawRobot(const Disturbances& disturbances, std::uint64_t robot_seed,
                      std::uint64_t start_seed) {
  Random body(robot_seed, "robot");
  RobotErrors robot;
  robot.odometry_scale = 1.0 + disturbances.odometry_scale * body.Normal();
  robot.heading_bias_rad_per_m = disturbances.heading_bias_rad_per_m * body.Normal();
  robot.wheel_base = 1.0 + disturbances.wheel_base * body.Normal();
  robot.slip = disturbances.slip;

  Random camera(robot_seed, "camera");
  robot.camera_yaw_rad = disturbances.camera_yaw_rad * camera.Normal();
  robot.camera_pitch_rad = disturbances.camera_pitch_rad * camera.Normal();
  robot.camera_height_m = disturbances.camera_height_m * camera.Normal();
  robot.gain = disturbances.gain_low *
               std::pow(disturbances.gain_high / disturbances.gain_low, camera.Uniform());

  Random start(start_seed, "start");
  robot.start_left_m = disturbances.start_sideways_m * start.Normal();
  robot.start_ahead_m = disturbances.start_along_m * start.Normal();
  robot.start_heading_rad = disturbances.start_heading_rad * start.Normal();
  return robot;
}

}  // namespace trailcast::sim
