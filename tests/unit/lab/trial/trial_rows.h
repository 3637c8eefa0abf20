#pragma once

#include <cmath>

#include "services/lab/trial/trial_report.h"

namespace trailcast::test {

// Returns a trial that ended at this offset from the taught end.
inline trial::TrialRow EndedAt(double x_m, double y_m) {
  trial::TrialRow row;
  row.scenario = "indoor";
  row.method = "default";
  row.scout_camera = "webcam";
  row.follower_camera = "wide";
  row.state = "arrived";
  row.arrived = true;
  row.end_m = {10.0, 5.0};
  row.verdict.final_m = row.end_m + Eigen::Vector2d(x_m, y_m);
  row.verdict.final_error_m = std::hypot(x_m, y_m);
  return row;
}

}  // namespace trailcast::test
