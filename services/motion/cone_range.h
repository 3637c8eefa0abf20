#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/motion/motion.h"

namespace trailcast::motion {

// One look of a sensor (sonar, infrared) that tells how far the nearest thing within its cone is,
// and not where in it. One of a fixed distance has its least and most range there (REP 117).
struct ConeRange {
  double field_rad = 0.0;  // the whole cone
  double least_m = 0.0;    // what it can measure
  double most_m = 0.0;
  float range_m = 0.0F;
};

// Whether it can be such a sensor's: a cone of at most half a turn, a least range that is finite
// and at most the most.
[[nodiscard]] bool Plausible(const ConeRange& range);

// Where what it sees may be, at most kArc_m apart, seen from the axle: x ahead, y left. What it
// cannot measure is nothing there: NaN, infinite, 0, below its least range; its most range, too,
// which many drivers say for nothing. Minus infinity is something nearer than it can measure (REP
// 117), and put at its least range.
[[nodiscard]] std::vector<Eigen::Vector2d> Points(const ConeRange& range,
                                                  const Pose2& axle_from_sensor);

constexpr double kArc_m = 0.05;

}  // namespace trailcast::motion
