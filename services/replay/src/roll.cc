#include "services/replay/roll.h"

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "services/base/angles.h"

namespace trailcast::replay {
namespace {

constexpr double kShortestBase_px = 15.0;  // the direction of a shorter pair is noise

double Direction(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

// Returns the least-squares rotation of the centred points (Umeyama's, in the plane).
double RotationOf(std::span<const ImagePair> pairs, const std::vector<bool>& use, int count) {
  Eigen::Vector2d current = Eigen::Vector2d::Zero();
  Eigen::Vector2d stored = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!use[i]) continue;
    current += pairs[i].current_px / count;
    stored += pairs[i].stored_px / count;
  }
  double sine = 0.0;
  double cosine = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!use[i]) continue;
    const Eigen::Vector2d c = pairs[i].current_px - current;
    const Eigen::Vector2d d = pairs[i].stored_px - stored;
    cosine += c.dot(d);
    sine += c.x() * d.y() - c.y() * d.x();
  }
  return std::atan2(sine, cosine);
}

}  // namespace

Roll EstimateRoll(std::span<const ImagePair> pairs, const RollOptions& options) {
  if (pairs.size() < 3) return {};
  std::minstd_rand random(1);
  std::vector<bool> best(pairs.size());
  int best_count = 0;
  std::vector<bool> inlier(pairs.size());
  for (int draw = 0; draw < options.draws; ++draw) {
    const ImagePair& a = pairs[random() % pairs.size()];
    const ImagePair& b = pairs[random() % pairs.size()];
    const Eigen::Vector2d current = b.current_px - a.current_px;
    const Eigen::Vector2d stored = b.stored_px - a.stored_px;
    if (current.norm() < kShortestBase_px || stored.norm() < kShortestBase_px) continue;
    const double angle_rad = WrapAngle(Direction(stored) - Direction(current));
    if (std::abs(angle_rad) > options.largest_rad) continue;
    const Eigen::Matrix2d turn =
        Eigen::Rotation2Dd(angle_rad).toRotationMatrix() * (stored.norm() / current.norm());
    int count = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Eigen::Vector2d predicted = a.stored_px + turn * (pairs[i].current_px - a.current_px);
      inlier[i] = (predicted - pairs[i].stored_px).norm() <= options.tolerance_px;
      count += inlier[i] ? 1 : 0;
    }
    if (count > best_count) {
      best_count = count;
      best = inlier;
    }
  }
  if (best_count < 3 || best_count < options.min_inlier_share * static_cast<double>(pairs.size())) {
    return {};
  }
  return {RotationOf(pairs, best, best_count), best_count};
}

Eigen::Vector2d Unroll(const Eigen::Vector2d& current_px, double angle_rad) {
  return Eigen::Rotation2Dd(angle_rad) * current_px;
}

}  // namespace trailcast::replay
