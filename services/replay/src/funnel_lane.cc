#include "services/replay/funnel_lane.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace trailcast::replay {

bool InsideFunnel(const FunnelPair& pair) {
  return std::abs(pair.current_u_px) < std::abs(pair.milestone_u_px) &&
         std::signbit(pair.current_u_px) == std::signbit(pair.milestone_u_px);
}

double DistanceToLine(const FunnelPair& pair) {
  return (pair.current_u_px - pair.milestone_u_px) / std::numbers::sqrt2;
}

double FeatureTurn(const FunnelPair& pair, double gain) {
  const double u_c = pair.current_u_px;
  const double u_d = pair.milestone_u_px;
  if (u_c > 0.0 && u_c > u_d) return gain * std::min(u_c, DistanceToLine(pair));
  if (u_c < 0.0 && u_c < u_d) return gain * std::max(u_c, DistanceToLine(pair));
  return 0.0;
}

double MeanFeatureTurn(std::span<const FunnelPair> pairs, double gain) {
  if (pairs.empty()) return 0.0;
  double sum = 0.0;
  for (const FunnelPair& pair : pairs) sum += FeatureTurn(pair, gain);
  return sum / static_cast<double>(pairs.size());
}

int MajorityTurn(std::span<const FunnelPair> pairs) {
  int votes = 0;
  for (const FunnelPair& pair : pairs) {
    const double turn = FeatureTurn(pair, 1.0);
    votes += turn > 0.0 ? 1 : turn < 0.0 ? -1 : 0;
  }
  if (5 * std::abs(votes) < static_cast<int>(pairs.size())) return 0;
  return votes > 0 ? 1 : votes < 0 ? -1 : 0;
}

double FuseTurns(double vision_rad, double odometry_rad, double eta) {
  return eta * vision_rad + (1.0 - eta) * odometry_rad;
}

}  // namespace trailcast::replay
