#pragma once

#include <Eigen/Core>

#include "services/replay/taught_flow.h"

namespace trailcast::replay {

// This is where a follower's camera is beside the taught path, and how it differs from the scout's.
// It converts what the camera sees to the scout's terms.
struct CameraPlace {
  ScoutCamera scout;
  double scout_width_px = 0.0;
  double along_m = 0.0;  // along the segment as if it had been driven forwards
  double left_m = 0.0;
  double left_sigma_m = 0.0;
  double yaw_rad = 0.0;    // to the left of where the scout's camera looked
  double height_m = 0.0;   // above the scout's camera
  double roll_rad = 0.0;   // of this frame
  double pitch_rad = 0.0;  // of this frame
  double magnification = 1.0;
  double distortion = 0.0;

  // Returns where the scout, on the path itself, would have seen what this camera sees at `seen_px`
  // (from its image centre) at that inverse depth (1/m) from here.
  [[nodiscard]] Eigen::Vector2d AsTaught(const Eigen::Vector2d& seen_px,
                                         double inverse_depth_per_m) const;
};

}  // namespace trailcast::replay
