#pragma once

#include <optional>
#include <vector>

#include "services/odometry/odometry_worth.h"

namespace trailcast::odometry {

// The two turn rates within one window.
struct TurnPair {
  double t_s = 0.0;
  double picture_radps = 0.0;
  double odometry_radps = 0.0;
};

// Fits the line near which most of the pairs are (least squares with Cauchy weights). Returns
// nothing if the drive turns too little.
[[nodiscard]] std::optional<TurnFit> FitTurn(const std::vector<TurnPair>& pairs);

}  // namespace trailcast::odometry
