#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/motion/motion.h"

namespace trailcast::motion {

// One reading of a sensor (sonar, infrared) that tells how far the nearest thing within its cone
// is, but not where in the cone. A sensor of a fixed distance has it as its least and its most
// range (REP 117).
struct ConeRange {
  double field_rad = 0.0;  // the whole cone
  double least_m = 0.0;    // the range that it can measure
  double most_m = 0.0;
  float range_m = 0.0F;
};

// Says whether a sensor can give this reading: its cone is at most half a turn, and its least range
// is finite and at most its most range.
[[nodiscard]] bool Plausible(const ConeRange& range);

// Returns where the sensed thing may be, as points at most kArc_m apart, seen from the axle: x
// ahead, y left. A range that cannot be measured means that nothing is there: NaN, infinity, 0, or
// less than the least range; also the most range, which many drivers give for nothing. Minus
// infinity means that something is too near to measure (REP 117) and counts as the least range.
[[nodiscard]] std::vector<Eigen::Vector2d> Points(const ConeRange& range,
                                                  const Pose2& axle_from_sensor);

constexpr double kArc_m = 0.05;

}  // namespace trailcast::motion
