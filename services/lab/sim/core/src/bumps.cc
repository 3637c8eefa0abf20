#include "services/lab/sim/core/bumps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trailcast::sim {
namespace {

constexpr double kEdge_m = 0.3;
constexpr int kWaves = 12;
constexpr double kShortest_m = 0.15;
constexpr double kLongest_m = 0.6;

// Returns bumps with an RMS of 1, from waves of all directions with lengths between the two.
double Bumps(const Eigen::Vector2d& place) {
  double sum = 0.0;
  for (int i = 0; i < kWaves; ++i) {
    const double direction_rad = 2.399963 * i;  // the golden angle, so that no two are alike
    const double share = (i + 0.5) / kWaves;
    const double length_m = kShortest_m * std::pow(kLongest_m / kShortest_m, share);
    const double along_m =
        place.dot(Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad)));
    sum += std::sin(2.0 * std::numbers::pi * along_m / length_m + 1.7 * i);
  }
  return sum * std::sqrt(2.0 / kWaves);
}

}  // namespace

double BumpAt(const std::vector<RoughPatch>& patches, const Eigen::Vector2d& place) {
  double height_m = 0.0;
  for (const RoughPatch& patch : patches) {
    const double inside_m = patch.radius_m - (place - patch.at).norm();
    if (inside_m <= 0.0) continue;
    height_m += patch.height_m * std::min(1.0, inside_m / kEdge_m) * Bumps(place);
  }
  return height_m;
}

}  // namespace trailcast::sim
