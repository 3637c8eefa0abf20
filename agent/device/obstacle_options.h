#pragma once

namespace trailcast::agent {

// A robot and its scanner, as far as standing before an obstacle goes. The robot is taken to reach
// as far ahead of its axle as half its width, or to its scanner if that is further.
struct ObstacleOptions {
  double scan_ahead_m = 0.0;  // from the axle to the scanner
  double robot_width_m = 0.5;
  double gap_m = 0.3;  // left between the robot and what it stands before
};

}  // namespace trailcast::agent
