#include "services/replay/turn_flow.h"

#include <Eigen/Dense>
#include <cmath>

#include "services/base/square.h"
#include "services/replay/taught_flow.h"

namespace trailcast::replay {
namespace {

constexpr double kLeastTurn_rad = 0.1;
constexpr std::size_t kFewest = 12;
constexpr double kUsualSigma = 0.5;     // relative; of a robot's camera from the usual one
constexpr double kNoise_share = 0.005;  // share of the width: a tracker's drift
constexpr double kCauchy_share = 0.01;
constexpr int kTurnIterations = 10;
constexpr double kStep = 1e-4;
// Wheels slip, and a turn carries a camera aside that is not above the axle, which moves near
// features.
constexpr double kLeastSigma = 0.05;

}  // namespace

void TurnFlow::Look(const std::vector<route::TrackedFeature>& seen, double turned_rad) {
  heading_rad_ += turned_rad;
  for (const route::TrackedFeature& feature : seen) {
    const auto [entry, first] =
        moved_.try_emplace(feature.id, Moved{feature, heading_rad_, feature, 0.0});
    Moved& moved = entry->second;
    const double turn_rad = heading_rad_ - moved.from_rad;
    if (first || std::abs(turn_rad) <= std::abs(moved.turned_rad)) continue;
    moved.to = feature;
    moved.turned_rad = turn_rad;
  }
}

std::optional<FocalLength> TurnFlow::focal() const {
  std::vector<Moved> used;
  for (const auto& [id, moved] : moved_) {
    if (std::abs(moved.turned_rad) >= kLeastTurn_rad) used.push_back(moved);
  }
  if (used.size() < kFewest) return std::nullopt;
  const TaughtFlowOptions webcam;
  const Eigen::Vector2d usual(std::log(webcam.focal_share * width_px_), webcam.widening);
  const Eigen::Matrix2d prior =
      Eigen::Vector2d(1.0 / Square(kUsualSigma), 1.0 / Square(webcam.widening_sigma)).asDiagonal();
  const auto moves_u = [](const Moved& moved, const Eigen::Vector2d& lens) {
    const ScoutCamera camera{std::exp(lens[0]), lens[1]};
    return camera.Turned({moved.from.u_px, moved.from.v_px}, moved.turned_rad).x();
  };
  Eigen::Vector2d lens = usual;
  Eigen::Matrix2d information = prior;
  for (int i = 0; i < kTurnIterations; ++i) {
    information = prior;
    Eigen::Vector2d gradient = prior * (usual - lens);
    for (const Moved& moved : used) {
      const double residual_px = moved.to.u_px - moves_u(moved, lens);
      const Eigen::Vector2d slope(
          (moves_u(moved, lens + Eigen::Vector2d(kStep, 0.0)) - moves_u(moved, lens)) / kStep,
          (moves_u(moved, lens + Eigen::Vector2d(0.0, kStep)) - moves_u(moved, lens)) / kStep);
      const double weight = 1.0 / (Square(kNoise_share * width_px_) *
                                   (1.0 + Square(residual_px / (kCauchy_share * width_px_))));
      information += weight * slope * slope.transpose();
      gradient += weight * residual_px * slope;
    }
    lens += information.ldlt().solve(gradient);
  }
  const double sigma = std::sqrt(information.inverse()(0, 0));
  return FocalLength{std::exp(lens[0]), std::hypot(sigma, kLeastSigma)};
}

}  // namespace trailcast::replay
