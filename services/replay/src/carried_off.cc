#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "services/base/square.h"
#include "services/replay/path_estimator.h"

namespace trailcast::replay {
namespace {

// The search starts at these places, to either side or along the path: closer together than the
// depths in view are far apart. From each the fit narrows down: at first every feature counts, and
// in the end only those that agree.
constexpr double kFurthest_m = 3.0;
constexpr double kApart_m = 0.5;
constexpr double kWidest = 8.0;  // multiple of Cauchy's own width
constexpr int kPlaceIterations = 6;
// A given place may be off by this many standard deviations.
constexpr double kLikely = 2.0;
// The magnification may be off by this many from that of a camera like the scout's.
constexpr double kAlike = 2.0;

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
  for (int iteration = 0; iteration < kPlaceIterations; ++iteration) {
    const Equations equations = Linearise(start, prior, seen, width * options_.cauchy_px);
    start += equations.information.ldlt().solve(equations.gradient);
    width = std::max(1.0, 0.5 * width);
  }
  return start;
}

std::pair<PathEstimator::State, double> PathEstimator::LeastSurprising(
    Index index, double furthest_m, const State& about, const Prior& prior,
    const std::vector<route::TrackedFeature>& seen) const {
  State best = about;
  double least = std::numeric_limits<double>::infinity();
  const double steps = std::ceil(furthest_m / kApart_m);
  for (double step = -steps; step <= steps; ++step) {
    State start = about;
    start[index] += step * furthest_m / steps;
    const State there = FromFarAway(start, prior, seen);
    const double surprise = Surprise(there, prior, seen);
    if (surprise >= least) continue;
    least = surprise;
    best = there;
  }
  return {best, least};
}

PathEstimator::Prior PathEstimator::FindWhereAlong(const Prior& before,
                                                   const std::vector<route::TrackedFeature>& seen) {
  const auto with_camera = [&](double magnification, double sigma) {
    State mean = before.mean;
    mean[kMagnification] = magnification;
    Covariance covariance = before.covariance;
    covariance(kMagnification, kMagnification) = Square(sigma * magnification);
    return Prior(mean, covariance);
  };
  const double furthest_m = std::min(kFurthest_m, kLikely * rough_->along_sigma_m);
  double magnification = before.mean[kMagnification];
  double sigma = options_.found_magnification;
  if (const auto own = std::exchange(rough_, std::nullopt)->focal) {
    magnification = MagnificationBy(*own);
    sigma = std::hypot(own->sigma, flow_.focal().sigma);
  }
  const Prior any_camera = with_camera(magnification, sigma);
  const auto by_any = LeastSurprising(kAlong, furthest_m, any_camera.mean, any_camera, seen);
  state_ = by_any.first;
  if (std::abs(std::log(magnification / own_magnification_)) > kAlike * sigma) return any_camera;
  const Prior same_camera = with_camera(own_magnification_, options_.same_camera);
  const auto by_same = LeastSurprising(kAlong, furthest_m, same_camera.mean, same_camera, seen);
  const double rarer = std::log(sigma / options_.same_camera);
  if (by_same.second >= by_any.second + rarer) return any_camera;
  state_ = by_same.first;
  known_ = {own_magnification_, same_camera.covariance(kMagnification, kMagnification), driven_m_};
  return same_camera;
}

std::optional<double> PathEstimator::FindIfCarriedOff(
    const Prior& before, const std::vector<route::TrackedFeature>& seen) {
  if (seen.size() < kFewestToFind) return std::nullopt;
  Covariance wide = before.covariance;
  wide(kLeft, kLeft) += Square(options_.carried_left_m);
  wide(kHeading, kHeading) += Square(options_.carried_heading_rad);
  wide(kAlong, kAlong) += Square(options_.carried_along_m);
  const Prior anywhere(before.mean, wide);
  const auto [best, least] = LeastSurprising(kLeft, kFurthest_m, before.mean, anywhere, seen);
  const double here = Surprise(state_, before, seen);
  const Equations there = Linearise(best, anywhere, seen, options_.cauchy_px);
  const int agreeing_here =
      Linearise(state_, anywhere, seen, options_.cauchy_px).agreement.agreeing;
  const Covariance covariance = there.information.inverse();
  const double moved_m = best[kLeft] - state_[kLeft];
  const double told_m = std::max(options_.carried_least_m, std::sqrt(covariance(kLeft, kLeft)));
  const bool elsewhere = std::abs(moved_m) >= told_m && std::abs(moved_m) <= kFurthest_m &&
                         there.agreement.agreeing > agreeing_here;
  const double most = options_.carried_gain_a_look;
  const double gain = elsewhere ? std::clamp(here - least, -most, most) : -most;
  const bool other_side = carried_ && elsewhere && (moved_m < 0.0) != carried_->to_the_right;
  if (!carried_ || other_side) carried_ = CarriedTo{moved_m < 0.0, driven_m_, 0.0};
  carried_->gain += gain;
  if (carried_->gain <= 0.0) carried_.reset();
  if (!carried_ || !elsewhere || carried_->gain < options_.carried_gain ||
      driven_m_ - carried_->driven_m < options_.carried_after_m) {
    return std::nullopt;
  }
  carried_.reset();
  state_ = best;
  covariance_ = covariance;
  known_.reset();
  return moved_m;
}

}  // namespace trailcast::replay
