#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "services/odometry/drive_step.h"
#include "services/odometry/turn_series.h"

namespace trailcast::odometry {

// Sums up a drive's steps since its beginning, so that the motion in any time is a difference.
class DriveTrack {
 public:
  // There must be at least one step.
  explicit DriveTrack(std::span<const DriveStep> steps);

  // The motion from `t_s` - `period_s` to `t_s` by the picture, and so much later by odometry.
  struct Window {
    double picture_rad = 0.0;
    double down_share = 0.0;
    double growth = 0.0;
    double flow = 0.0;
    double odometry_rad = 0.0;
    double driven_m = 0.0;
    bool known = false;  // the window is within the drive, the picture was followed, and odometry
                         // did not break
  };
  [[nodiscard]] Window Over(double t_s, double period_s, double odometry_late_s) const;

  [[nodiscard]] const std::vector<TimedValue>& picture_turn() const { return picture_rad_; }
  [[nodiscard]] const std::vector<TimedValue>& odometry_turn() const { return odometry_rad_; }
  [[nodiscard]] double begins_s() const { return picture_rad_.front().t_s; }
  [[nodiscard]] double ends_s() const { return picture_rad_.back().t_s; }

 private:
  using Sum = std::vector<TimedValue>;

  Sum picture_rad_;
  Sum down_share_;
  Sum growth_;
  Sum flow_;
  Sum odometry_rad_;
  Sum driven_m_;
  Sum unseen_;  // steps whose picture was not followed
  Sum broken_;
};

}  // namespace trailcast::odometry
