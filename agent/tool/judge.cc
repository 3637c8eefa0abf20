#include "agent/tool/judge.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace trailcast::tool {
namespace {

constexpr double kMinStep_m = 0.01;

double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + t * along)).norm();
}

}  // namespace

void DrivenPath::Add(const Eigen::Vector2d& point_m) {
  end_m_ = point_m;
  if (points_m_.empty() || (point_m - points_m_.back()).norm() >= kMinStep_m) {
    points_m_.push_back(point_m);
  }
}

double DrivenPath::DistanceTo(const Eigen::Vector2d& point_m) const {
  assert(!empty());
  double nearest = (point_m - points_m_.front()).norm();
  for (std::size_t i = 1; i < points_m_.size(); ++i) {
    nearest = std::min(nearest, DistanceToSegment(point_m, points_m_[i - 1], points_m_[i]));
  }
  return nearest;
}

double Judge::Observe(const Eigen::Vector2d& position_m) {
  const double error_m = taught_.DistanceTo(position_m);
  if (last_m_) {
    const double step_m = (position_m - *last_m_).norm();
    driven_m_ += step_m;
    error_integral_ += 0.5 * (error_m + last_error_m_) * step_m;
  }
  if (driven_m_ >= kSettlingDistance_m) {
    max_settled_m_ = std::max(max_settled_m_.value_or(0.0), error_m);
  }
  worst_m_ = std::max(worst_m_, error_m);
  last_m_ = position_m;
  last_error_m_ = error_m;
  replayed_.Add(position_m);
  return error_m;
}

Verdict Judge::verdict() const {
  Verdict verdict;
  if (!last_m_) return verdict;
  verdict.final_m = *last_m_;
  verdict.final_error_m = (*last_m_ - taught_.end_m()).norm();
  verdict.mean_path_error_m = driven_m_ > 0.0 ? error_integral_ / driven_m_ : last_error_m_;
  verdict.max_path_error_m = max_settled_m_.value_or(last_error_m_);
  verdict.worst_path_error_m = worst_m_;
  verdict.driven_m = driven_m_;
  return verdict;
}

}  // namespace trailcast::tool
