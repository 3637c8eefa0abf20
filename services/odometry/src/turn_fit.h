#pragma once

#include <optional>
#include <vector>

#include "services/odometry/odometry_worth.h"

namespace trailcast::odometry {

// Within one window.
struct TurnPair {
  double t_s = 0.0;
  double picture_radps = 0.0;
  double odometry_radps = 0.0;
};

// The line through the pairs that most of them are near (least squares, Cauchy weights). Nothing:
// too little is turned.
[[nodiscard]] std::optional<TurnFit> FitTurn(const std::vector<TurnPair>& pairs);

}  // namespace trailcast::odometry
