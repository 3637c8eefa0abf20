#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "services/base/square.h"
#include "services/replay/path_estimator.h"

namespace trailcast::replay {
namespace {

// Starting places of the search, to either side or along the path: closer together than the depths
// in view are far apart. From each the fit comes in from afar: at first every feature counts, at
// last only those that agree.
constexpr double kFurthest_m = 3.0;
constexpr double kApart_m = 0.5;
constexpr double kWidest = 8.0;  // times Cauchy's own width
constexpr int kIterations = 6;
constexpr double kSamePlace_m = 0.4;  // from one look to the next

}  // namespace

double PathEstimator::Surprise(const State& state, const Prior& prior,
                               const std::vector<route::TrackedFeature>& seen) const {
  const State off = state - prior.mean;
  double nats = 0.5 * off.dot(prior.information * off);
  const double per_feature = 0.5 * Square(options_.cauchy_px / options_.feature_noise_px);
  for (const route::TrackedFeature& feature : seen) {
    const Prediction p = PredictFeature(static_cast<std::size_t>(feature.id), state);
    const double residual_px =
        std::hypot(feature.u_px - p.u_px, feature.v_px - p.v_px) / state[kMagnification];
    nats += per_feature * std::log1p(Square(residual_px / options_.cauchy_px));
  }
  return nats;
}

PathEstimator::State PathEstimator::FromFarAway(
    State start, const Prior& prior, const std::vector<route::TrackedFeature>& seen) const {
  double width = kWidest;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Equations equations = Linearise(start, prior, seen, width * options_.cauchy_px);
    start += equations.information.ldlt().solve(equations.gradient);
    width = std::max(1.0, 0.5 * width);
  }
  return start;
}

std::pair<PathEstimator::State, double> PathEstimator::LeastSurprising(
    Index index, const State& about, const Prior& prior,
    const std::vector<route::TrackedFeature>& seen) const {
  State best = about;
  double least = std::numeric_limits<double>::infinity();
  for (double off_m = -kFurthest_m; off_m <= kFurthest_m; off_m += kApart_m) {
    State start = about;
    start[index] += off_m;
    const State there = FromFarAway(start, prior, seen);
    const double surprise = Surprise(there, prior, seen);
    if (surprise >= least) continue;
    least = surprise;
    best = there;
  }
  return {best, least};
}

PathEstimator::Prior PathEstimator::FindWhereAlong(const Prior& any_camera,
                                                   const std::vector<route::TrackedFeature>& seen) {
  along_is_rough_ = false;
  State mean = any_camera.mean;
  mean[kMagnification] = own_magnification_;
  Covariance alike = any_camera.covariance;
  alike(kMagnification, kMagnification) = Square(options_.same_camera * own_magnification_);
  const Prior same_camera(mean, alike);
  const auto by_same = LeastSurprising(kAlong, mean, same_camera, seen);
  const auto by_any = LeastSurprising(kAlong, any_camera.mean, any_camera, seen);
  const double rarer = std::log(options_.found_magnification / options_.same_camera);
  const bool same = by_same.second < by_any.second + rarer;
  state_ = same ? by_same.first : by_any.first;
  return same ? same_camera : any_camera;
}

std::optional<double> PathEstimator::FindIfCarriedOff(
    const Prior& before, const std::vector<route::TrackedFeature>& seen) {
  if (seen.size() < kFewestToFind) return std::nullopt;
  Covariance wide = before.covariance;
  wide(kLeft, kLeft) += Square(options_.carried_left_m);
  wide(kHeading, kHeading) += Square(options_.carried_heading_rad);
  wide(kAlong, kAlong) += Square(options_.carried_along_m);
  const Prior anywhere(before.mean, wide);
  const auto [best, least] = LeastSurprising(kLeft, before.mean, anywhere, seen);
  const double here = Surprise(state_, before, seen);
  const Equations there = Linearise(best, anywhere, seen, options_.cauchy_px);
  const int agreeing_here =
      Linearise(state_, anywhere, seen, options_.cauchy_px).agreement.agreeing;
  const Covariance covariance = there.information.inverse();
  const double moved_m = best[kLeft] - state_[kLeft];
  const double told_m = std::max(options_.carried_least_m, std::sqrt(covariance(kLeft, kLeft)));
  const bool far_better = std::abs(moved_m) >= told_m && std::abs(moved_m) <= kFurthest_m &&
                          here - least >= options_.carried_gain &&
                          there.agreement.agreeing > agreeing_here;
  if (!far_better) {
    carried_.reset();
    return std::nullopt;
  }
  const bool again = carried_ && std::abs(best[kLeft] - carried_->left_m) < kSamePlace_m;
  if (!again) carried_ = CarriedTo{.driven_m = driven_m_};
  carried_->left_m = best[kLeft];
  ++carried_->looks;
  if (carried_->looks < options_.carried_looks ||
      driven_m_ - carried_->driven_m < options_.carried_after_m) {
    return std::nullopt;
  }
  carried_.reset();
  state_ = best;
  covariance_ = covariance;
  return moved_m;
}

}  // namespace trailcast::replay
