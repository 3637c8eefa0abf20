#include "services/lab/trial/path_judge.h"

#include <algorithm>
#include <cassert>

#include "services/lab/sim/core/path.h"

namespace trailcast::trial {
namespace {

constexpr double kMinStep_m = 0.01;

}  // namespace

void TruePath::Add(const Eigen::Vector2d& point_m) {
  end_m_ = point_m;
  const double step_m = points_m_.empty() ? 0.0 : (point_m - points_m_.back()).norm();
  if (!points_m_.empty() && step_m < kMinStep_m) return;
  points_m_.push_back(point_m);
  length_m_ += step_m;
}

double TruePath::DistanceTo(const Eigen::Vector2d& point_m) const {
  assert(!empty());
  if (points_m_.size() == 1) return (point_m - points_m_.front()).norm();
  return sim::Nearest(points_m_, point_m).distance_m;
}

double PathJudge::Observe(const Eigen::Vector2d& position_m) {
  const double error_m = taught_.DistanceTo(position_m);
  if (last_m_) {
    const double step_m = (position_m - *last_m_).norm();
    driven_m_ += step_m;
    if (step_m > 0.0) sections_.push_back({0.5 * (error_m + last_error_m_), step_m});
  }
  if (driven_m_ >= kSettlingDistance_m) {
    max_settled_m_ = std::max(max_settled_m_.value_or(0.0), error_m);
  }
  worst_m_ = std::max(worst_m_, error_m);
  if (pushed_at_m_ && !after_push_m_ && driven_m_ - *pushed_at_m_ >= kReturnDistance_m) {
    after_push_m_ = error_m;
  }
  last_m_ = position_m;
  last_error_m_ = error_m;
  replayed_.Add(position_m);
  return error_m;
}

void PathJudge::NotePush() {
  pushed_at_m_ = driven_m_;
  last_m_.reset();
}

// Returns the distance that the robot kept for a share of the metres that it drove.
double PathJudge::WithinFor(double share) const {
  std::vector<Section> by_error = sections_;
  std::sort(by_error.begin(), by_error.end(),
            [](const Section& a, const Section& b) { return a.error_m < b.error_m; });
  double left_m = share * driven_m_;
  for (const Section& section : by_error) {
    left_m -= section.driven_m;
    if (left_m <= 0.0) return section.error_m;
  }
  return by_error.empty() ? last_error_m_ : by_error.back().error_m;
}

PathVerdict PathJudge::verdict() const {
  PathVerdict verdict;
  if (!last_m_) return verdict;
  verdict.final_m = *last_m_;
  verdict.final_error_m = (*last_m_ - taught_.end_m()).norm();
  double integral = 0.0;  // metres of error times metres driven
  for (const Section& section : sections_) integral += section.error_m * section.driven_m;
  verdict.mean_path_error_m = driven_m_ > 0.0 ? integral / driven_m_ : last_error_m_;
  verdict.p90_path_error_m = WithinFor(0.9);
  verdict.max_path_error_m = max_settled_m_.value_or(last_error_m_);
  verdict.worst_path_error_m = worst_m_;
  verdict.driven_m = driven_m_;
  verdict.after_push_m = after_push_m_;
  return verdict;
}

}  // namespace trailcast::trial
