#pragma once

#include <cstdint>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene.h"

namespace trailcast::sim {

// How much robots differ from their drawings and from each other, and how much goes wrong on the
// way, as standard deviations unless said otherwise. The defaults are those of trials.
struct Disturbances {
  double odometry_scale = 0.01;
  double heading_bias_rad_per_m = 0.00523599;  // 0.3 degrees
  double wheel_base = 0.01;
  double slip = 0.02;                   // of each wheel's motion in a step; 0.05 on rough ground
  double camera_yaw_rad = 0.0261799;    // 1.5 degrees
  double camera_pitch_rad = 0.0174533;  // 1 degree
  double camera_height_m = 0.03;
  double start_sideways_m = 0.05;
  double start_along_m = 0.10;
  double start_heading_rad = 0.0523599;  // 3 degrees
  // The exposure gain relative to the scout's is between these, evenly distributed in its
  // logarithm.
  double gain_low = 0.7;
  double gain_high = 1.4;

  // Returns those of a scout, which starts where its path does, and whose exposure is the reference
  // for the follower's.
  [[nodiscard]] static Disturbances ForScout();
  // Returns those of a robot as drawn, with a start as given, for tests and demonstrations of
  // principle.
  [[nodiscard]] static Disturbances None();
};

// The errors of one robot.
struct RobotErrors {
  double odometry_scale = 1.0;  // metres driven for each metre of odometry
  double heading_bias_rad_per_m = 0.0;
  double wheel_base = 1.0;  // true one over nominal one
  double slip = 0.0;
  double camera_yaw_rad = 0.0;
  double camera_pitch_rad = 0.0;
  double camera_height_m = 0.0;
  double start_left_m = 0.0;
  double start_ahead_m = 0.0;
  double start_heading_rad = 0.0;
  double gain = 1.0;
};

// Returns the light some hours later: the sun is 15 to 45 degrees to either side, and up to 10
// higher or lower.
[[nodiscard]] Lighting WithMovedSun(const Lighting& lighting, std::uint64_t seed);

// Draws body and camera from `robot_seed`, and the start from `start_seed`, so that the same robot
// can start twice.
[[nodiscard]] RobotErrors DrawRobot(const Disturbances& disturbances, std::uint64_t robot_seed,
                                    std::uint64_t start_seed);
// The same seed gives the same robot at the same start.
[[nodiscard]] inline RobotErrors DrawRobot(const Disturbances& disturbances, std::uint64_t seed) {
  return DrawRobot(disturbances, seed, seed);
}

}  // namespace trailcast::sim
