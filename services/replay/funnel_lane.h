#pragma once

#include <span>

namespace trailcast::replay {

// The funnel lane of Chen & Birchfield 2009, section II. All u are x-coordinates in pixels from the
// image centre, positive to the right; all turns are desired heading changes in radians, positive
// to the right.

// One feature's coordinate in the current image (uC) and in the milestone image (uD).
struct FunnelPair {
  double current_u_px = 0.0;
  double milestone_u_px = 0.0;
};

// Constraint 1 (|uC| < |uD|) and constraint 2 (sign(uC) = sign(uD)) together.
[[nodiscard]] bool InsideFunnel(const FunnelPair& pair);

// phi(uC, uD) = (uC - uD) / sqrt(2): signed distance to the line uC = uD.
[[nodiscard]] double DistanceToLine(const FunnelPair& pair);

// The turn one feature asks for; zero where it is content. `gain` is gamma, radians per pixel.
[[nodiscard]] double FeatureTurn(const FunnelPair& pair, double gain);

// (1/N) sum of FeatureTurn: the visual half of equation (1). Zero without features.
[[nodiscard]] double MeanFeatureTurn(std::span<const FunnelPair> pairs, double gain);

// The first version's control (ICRA 2006): which way the features vote, whatever they ask for: -1
// left, +1 right, 0 where neither has a fifth of them more than the other.
[[nodiscard]] int MajorityTurn(std::span<const FunnelPair> pairs);

// Equation (1): eta * vision + (1 - eta) * odometry.
[[nodiscard]] double FuseTurns(double vision_rad, double odometry_rad, double eta);

}  // namespace trailcast::replay
