#pragma once

#include <span>

namespace trailcast::replay {

// This is the funnel lane of Chen & Birchfield 2009, section II. All u are x-coordinates in pixels
// from the image centre, positive to the right. All turns are desired heading changes in radians,
// positive to the right.

// This is one feature's coordinate in the current image (uC) and in the milestone image (uD).
struct FunnelPair {
  double current_u_px = 0.0;
  double milestone_u_px = 0.0;
};

// Tests constraint 1 (|uC| < |uD|) and constraint 2 (sign(uC) = sign(uD)) together.
[[nodiscard]] bool InsideFunnel(const FunnelPair& pair);

// Returns phi(uC, uD) = (uC - uD) / sqrt(2), the signed distance to the line uC = uD.
[[nodiscard]] double DistanceToLine(const FunnelPair& pair);

// Returns the turn that one feature asks for, or zero in the funnel lane. `gain` is gamma, in
// radians per pixel.
[[nodiscard]] double FeatureTurn(const FunnelPair& pair, double gain);

// Returns (1/N) sum of FeatureTurn, the visual half of equation (1), or zero without features.
[[nodiscard]] double MeanFeatureTurn(std::span<const FunnelPair> pairs, double gain);

// This is the first version's control (ICRA 2006). It returns the majority of the features, however
// large their turns: -1 left, +1 right, 0 if neither side has a fifth of them more than the other.
[[nodiscard]] int MajorityTurn(std::span<const FunnelPair> pairs);

// Returns equation (1): eta * vision + (1 - eta) * odometry.
[[nodiscard]] double FuseTurns(double vision_rad, double odometry_rad, double eta);

}  // namespace trailcast::replay
