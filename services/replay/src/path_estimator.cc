#include "services/replay/path_estimator.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "services/base/median.h"
#include "services/base/square.h"
#include "services/replay/src/as_forward.h"
#include "services/route/heading.h"
#include "services/route/track.h"

namespace trailcast::replay {
namespace {

constexpr int kUpdateIterations = 4;
constexpr double kFlowStep_m = 0.02;  // a track's flow is taken over this
constexpr double kTaughtCurvatureStep_m = 0.1;
// Two looks within these distances are from one place.
constexpr double kStands_m = 0.001;
constexpr double kStands_rad = 0.001;
constexpr std::size_t kFewestOfKnock = 10;  // a handful of features may be mismatches

void Count(double residual_px, double outlier_px, Agreement& agreement) {
  if (residual_px < outlier_px) {
    ++agreement.agreeing;
    return;
  }
  ++agreement.rejected;
  agreement.rejected_by_px += (residual_px - agreement.rejected_by_px) / agreement.rejected;
}

}  // namespace

PathEstimator::PathEstimator(int scout_width_px, double magnification,
                             const PathEstimatorOptions& options)
    : options_(options),
      scout_width_px_(scout_width_px),
      own_magnification_(magnification),
      flow_(scout_width_px, options.flow) {
  state_[kMagnification] = magnification;
  state_[kAhead] = options_.camera_ahead_m.value_or(0.0);
  covariance_(kAhead, kAhead) =
      Square(options_.camera_ahead_m ? options_.told_ahead_m : options_.untold_ahead_m);
  covariance_(kWay, kWay) = Square(options_.way_log);
  covariance_(kTurn, kTurn) = Square(options_.turn_log);
  BeUnsure();
}

void PathEstimator::Begin(const route::Segment& segment) {
  state_[kAlong] += EntryOf(segment) - ExitOf(segment_);
  // This is the path before the segment's start: the last segment if both are driven forwards,
  // otherwise the bend continues.
  const bool on = !segment.reverse && !segment_.reverse;
  last_heading_ = on ? segment_.heading : segment.heading;
  last_length_m_ = on ? segment_.length_m : 0.0;
  segment_ = segment;
  depths_ = flow_.Depths(segment_);
  last_look_.reset();
}

void PathEstimator::Restart(const route::Segment& segment, double along_m) {
  state_[kLeft] = state_[kHeading] = 0.0;
  carried_.reset();
  rough_.reset();
  BeUnsure();
  state_[kAlong] = ExitOf(segment_) - EntryOf(segment) + along_m;
  Begin(segment);
  last_heading_ = {};
}

void PathEstimator::BeUnsureWhereAlong(const RoughPlace& rough) {
  rough_ = rough;
  known_.reset();
  covariance_(kAlong, kAlong) = Square(rough.along_sigma_m);
  if (rough.focal) state_[kMagnification] = MagnificationBy(*rough.focal);
  covariance_(kMagnification, kMagnification) =
      Square(options_.found_magnification * state_[kMagnification]);
}

double PathEstimator::WayScale() const { return std::exp(state_[kWay]); }

double PathEstimator::TurnScale() const { return std::exp(state_[kTurn]); }

FocalLength PathEstimator::focal() const {
  const FocalLength scouts = flow_.focal();
  const double k = state_[kMagnification];
  return {k * scouts.px,
          std::hypot(scouts.sigma, std::sqrt(covariance_(kMagnification, kMagnification)) / k)};
}

void PathEstimator::StartAt(const route::Segment& segment) {
  Restart(segment, EntryOf(segment) + state_[kAhead]);
  // Errors seen here are attributed to the robot's given place, not to its mount: on a straight
  // path nothing would ever correct the latter.
  covariance_(kAlong, kAlong) += covariance_(kAhead, kAhead);
}

void PathEstimator::TurnAxes(double turn_rad) {
  Covariance rotated = Covariance::Identity();
  rotated(kAlong, kAlong) = rotated(kLeft, kLeft) = std::cos(turn_rad);
  rotated(kAlong, kLeft) = std::sin(turn_rad);
  rotated(kLeft, kAlong) = -std::sin(turn_rad);
  state_ = rotated * state_;
  covariance_ = rotated * covariance_ * rotated.transpose();
  state_[kHeading] -= turn_rad;
}

void PathEstimator::CountAlong(const route::Segment& segment, double along_m,
                               const motion::Pose2& there) {
  state_[kAlong] -= there.x_m;
  state_[kLeft] -= there.y_m;
  TurnAxes(there.heading_rad);
  state_[kAlong] += along_m;
  segment_ = segment;
  depths_ = flow_.Depths(segment_);
  last_heading_ = {};
  last_look_.reset();
  carried_.reset();
  known_.reset();
}

void PathEstimator::TurnPath(double turn_rad) {
  state_[kAlong] -= EntryOf(segment_);
  TurnAxes(turn_rad);
  state_[kAlong] += EntryOf(segment_);
  covariance_(kHeading, kHeading) += Square(options_.turn_noise_share * turn_rad);
  last_heading_ = {};
  last_look_.reset();
  carried_.reset();
}

double PathEstimator::TaughtHeading(double along_m) const {
  // Beyond the end the path goes straight on, since a cubic bends away.
  if (along_m >= 0.0) {
    return route::HeadingAt(segment_.heading, std::min(along_m, segment_.length_m));
  }
  return route::HeadingAt(last_heading_, last_length_m_ + along_m) -
         route::HeadingAt(last_heading_, last_length_m_);
}

double PathEstimator::TaughtTurn(double from_m, double to_m) const {
  return TaughtHeading(to_m) - TaughtHeading(from_m);
}

// Returns a feature's taught place from the knots before and behind, each moved to where its depth
// and the heading taught here predict it. On a straight line between them it would lag behind its
// true track, which is bent outwards, and in a bend to the side.
route::TrackKnot PathEstimator::TaughtPlaceAt(std::size_t index, double along_m) const {
  const route::Feature& feature = segment_.features[index];
  const ScoutCamera& camera = flow_.camera();
  const Eigen::Vector2d ahead(camera.ahead_u_px, camera.ahead_v_px);
  const double heading_rad = TaughtHeading(along_m);
  const auto moved = [&](const route::TrackKnot& knot) -> Eigen::Vector2d {
    const double knot_m = knot.s * segment_.length_m;
    const double nearer = depths_[index].Growth(knot_m, along_m);
    const Eigen::Vector2d place = ahead + nearer * (Eigen::Vector2d(knot.u_px, knot.v_px) - ahead);
    return camera.Turned(place, heading_rad - route::HeadingAt(segment_.heading, knot_m));
  };
  const double s = std::max(0.0, along_m) / std::max(1e-3, segment_.length_m);
  const route::TrackInterval interval = route::IntervalAt(feature, s);
  const Eigen::Vector2d place =
      (1.0 - interval.weight) * moved(interval.before) + interval.weight * moved(interval.after);
  return {0.0F, static_cast<float>(place.x()), static_cast<float>(place.y())};
}

// The learnt scales of its odometry and the learnt place of its camera on the robot stay true
// wherever the robot is.
void PathEstimator::BeUnsure() {
  known_.reset();
  const Eigen::Vector3d learnt = covariance_.diagonal().segment<3>(kWay);
  covariance_.setZero();
  covariance_.diagonal().segment<3>(kWay) = learnt;
  covariance_(kLeft, kLeft) = Square(options_.start_left_m);
  covariance_(kHeading, kHeading) = Square(options_.start_heading_rad);
  covariance_(kAlong, kAlong) = Square(options_.start_along_m);
  covariance_(kMagnification, kMagnification) =
      Square(options_.start_magnification * state_[kMagnification]);
  covariance_(kDistortion, kDistortion) = Square(options_.distortion);
  covariance_(kMountYaw, kMountYaw) = Square(options_.mount_yaw_rad);
  covariance_(kHeight, kHeight) = Square(options_.mount_height_m);
  covariance_(kBias, kBias) = Square(options_.heading_bias_rad_per_m);
  covariance_(kRoll, kRoll) = Square(options_.roll_rad);
  covariance_(kPitch, kPitch) = Square(options_.pitch_rad);
}

void PathEstimator::Predict(const motion::OdometryIncrement& moved) {
  driven_m_ += std::abs(moved.distance_m);
  if (last_look_) {
    last_look_->moved_m += std::abs(moved.distance_m);
    last_look_->turned_rad += std::abs(moved.heading_change_rad);
  }
  const double distance_m = WayScale() * moved.distance_m;
  const double change_rad = TurnScale() * moved.heading_change_rad;
  const double before_m = state_[kAlong];
  const double alpha = state_[kHeading];
  // Inside or outside a bend, the path's metres are longer or shorter than the robot's.
  const double curvature =
      TaughtTurn(before_m - 0.5 * kTaughtCurvatureStep_m, before_m + 0.5 * kTaughtCurvatureStep_m) /
      kTaughtCurvatureStep_m;
  const double stretch = std::clamp(1.0 - curvature * state_[kLeft], 0.5, 2.0);
  const double aside_m = state_[kAhead] * change_rad;  // of the camera
  const double along_m = (distance_m * std::cos(alpha) - aside_m * std::sin(alpha)) / stretch;
  const double turned = TaughtTurn(before_m, before_m + along_m);
  state_[kAlong] += along_m;
  state_[kLeft] +=
      distance_m * std::sin(alpha + 0.5 * change_rad - 0.5 * turned) + aside_m * std::cos(alpha);
  state_[kHeading] += change_rad + state_[kBias] * distance_m - turned;

  // A bend of the path tells how far ahead the camera is. Any other turn swings the camera just as
  // much, but is made because the robot is, or seems to be, off the path, so an error of its place
  // there would be attributed to the mount.
  const bool bends = std::abs(curvature) > options_.least_bend_per_m && !WasTurnedLately();
  const double bend_rad =
      bends ? std::clamp(turned, std::min(0.0, change_rad), std::max(0.0, change_rad)) : 0.0;
  Covariance f = Covariance::Identity();
  f(kLeft, kHeading) = distance_m;
  f(kLeft, kWay) = distance_m * std::sin(alpha);
  f(kAlong, kWay) = distance_m * std::cos(alpha) / stretch;
  f(kHeading, kWay) = -turned;
  f(kHeading, kTurn) = change_rad;
  f(kLeft, kAhead) = bend_rad * std::cos(alpha);
  f(kAlong, kAhead) = -bend_rad * std::sin(alpha) / stretch;
  f(kHeading, kBias) = distance_m;
  covariance_ = f * covariance_ * f.transpose();
  covariance_(kLeft, kLeft) += Square(change_rad - bend_rad) * covariance_(kAhead, kAhead);
  const double driven = std::abs(distance_m) + 0.2 * std::abs(change_rad);
  covariance_(kAlong, kAlong) += driven * Square(options_.along_noise);
  covariance_(kLeft, kLeft) +=
      driven * (Square(options_.left_noise_m) + Square(options_.left_noise_share * state_[kLeft]));
  covariance_(kHeading, kHeading) += driven * Square(options_.heading_noise_rad);
  covariance_(kWay, kWay) += std::abs(moved.distance_m) * Square(options_.way_log_noise);
  covariance_(kMagnification, kMagnification) +=
      driven * Square(options_.magnification_noise * state_[kMagnification]);
  // Each frame has its own roll and pitch.
  covariance_.middleRows<2>(kRoll).setZero();
  covariance_.middleCols<2>(kRoll).setZero();
  covariance_(kRoll, kRoll) = Square(options_.roll_rad);
  covariance_(kPitch, kPitch) = Square(options_.pitch_rad);
  state_[kRoll] = 0.0;
  state_[kPitch] = 0.0;
}

void PathEstimator::Widen(const motion::OdometryIncrement& unknown) {
  if (unknown.distance_m == 0.0 && unknown.heading_change_rad == 0.0) return;
  last_look_.reset();
  const double distance_m = WayScale() * unknown.distance_m;
  covariance_(kAlong, kAlong) += Square(distance_m);
  covariance_(kLeft, kLeft) += Square(distance_m * std::sin(unknown.heading_change_rad));
  covariance_(kHeading, kHeading) += Square(unknown.heading_change_rad);
}

PathEstimator::Prediction PathEstimator::PredictFeature(std::size_t index,
                                                        const State& state) const {
  const double along_m = state[kAlong];
  const route::TrackKnot taught = TaughtPlaceAt(index, along_m);
  const route::TrackKnot ahead = TaughtPlaceAt(index, along_m + kFlowStep_m);
  const double u = taught.u_px;
  const double v = taught.v_px;
  const ScoutCamera& camera = flow_.camera();
  const double f = camera.focal_px;
  const double k = state[kMagnification];
  const double rho = depths_[index].At(std::min(along_m, segment_.length_m));
  const double alpha = state[kHeading] + state[kMountYaw];
  const Eigen::Vector2d turned = camera.Turned({u, v}, alpha);
  const double turn_u = camera.TurnU(turned.x());
  const double turn_v = camera.TurnV(turned.x(), turned.y());
  const double scout_u = turned.x() + f * rho * state[kLeft] - v * state[kRoll];
  const double scout_v =
      turned.y() + u * state[kRoll] + f * state[kPitch] + f * rho * state[kHeight];
  Row du = Row::Zero();
  Row dv = Row::Zero();
  du[kLeft] = f * rho;
  du[kHeading] = du[kMountYaw] = turn_u;
  du[kAlong] = (ahead.u_px - taught.u_px) / kFlowStep_m;
  du[kRoll] = -v;
  dv[kHeading] = dv[kMountYaw] = turn_v;
  dv[kAlong] = (ahead.v_px - taught.v_px) / kFlowStep_m;
  dv[kRoll] = u;
  dv[kPitch] = f;
  dv[kHeight] = f * rho;
  // This goes from the scout's lens to the follower's: magnified, and bent towards the edge.
  const double d = state[kDistortion];
  const double width2 = Square(scout_width_px_);
  const double radius2 = (Square(scout_u) + Square(scout_v)) / width2;
  const double bent = 1.0 + d * radius2;
  const Row dradius2 = 2.0 / width2 * (scout_u * du + scout_v * dv);
  Prediction p;
  p.u_px = k * bent * scout_u;
  p.v_px = k * bent * scout_v;
  p.du = k * (bent * du + d * scout_u * dradius2);
  p.dv = k * (bent * dv + d * scout_v * dradius2);
  p.du[kMagnification] = bent * scout_u;
  p.dv[kMagnification] = bent * scout_v;
  p.du[kDistortion] = k * radius2 * scout_u;
  p.dv[kDistortion] = k * radius2 * scout_v;
  p.depth_sigma_px = k * f * std::min(depths_[index].sigma_per_m, 0.5) * std::abs(state[kLeft]);
  return p;
}

CameraPlace PathEstimator::camera_place() const {
  CameraPlace place;
  place.scout = flow_.camera();
  place.scout_width_px = scout_width_px_;
  place.along_m = state_[kAlong];
  place.left_m = state_[kLeft];
  place.left_sigma_m = std::sqrt(covariance_(kLeft, kLeft));
  place.yaw_rad = state_[kHeading] + state_[kMountYaw];
  place.height_m = state_[kHeight];
  place.roll_rad = state_[kRoll];
  place.pitch_rad = state_[kPitch];
  place.magnification = state_[kMagnification];
  place.distortion = state_[kDistortion];
  return place;
}

PathEstimator::Prior::Prior(const State& state, const Covariance& uncertainty)
    : mean(state), covariance(uncertainty), information(uncertainty.inverse()) {}

PathEstimator::Equations PathEstimator::Linearise(const State& state, const Prior& prior,
                                                  const std::vector<route::TrackedFeature>& seen,
                                                  double cauchy_px) const {
  const double scale = prior.mean[kMagnification];
  Equations equations{prior.information, prior.information * (prior.mean - state), {}};
  for (const route::TrackedFeature& feature : seen) {
    const Prediction p = PredictFeature(static_cast<std::size_t>(feature.id), state);
    const double ru = feature.u_px - p.u_px;
    const double rv = feature.v_px - p.v_px;
    const double residual_px = std::hypot(ru, rv) / scale;
    Count(residual_px, options_.outlier_px, equations.agreement);
    // This is Cauchy's weight: a mismatch counts for little, wherever it is.
    const double robust = 1.0 / (1.0 + Square(residual_px / cauchy_px));
    const double noise_u = Square(scale * options_.feature_noise_px) + Square(p.depth_sigma_px);
    const double noise_v = Square(scale * options_.feature_noise_px);
    equations.information +=
        robust * (p.du.transpose() * p.du / noise_u + p.dv.transpose() * p.dv / noise_v);
    equations.gradient +=
        robust * (p.du.transpose() * ru / noise_u + p.dv.transpose() * rv / noise_v);
  }
  return equations;
}

bool PathEstimator::WasTurnedLately() const {
  return turned_at_m_ && driven_m_ - *turned_at_m_ < options_.knock_apart_m;
}

void PathEstimator::AllowForKnock(const std::vector<route::TrackedFeature>& seen) {
  if (seen.size() < kFewestOfKnock) return;
  const bool lost_sight = static_cast<double>(seen.size()) < options_.knock_seen * usually_seen_;
  if (lost_sight && !WasTurnedLately()) return;
  std::vector<double> turns_rad;
  for (const route::TrackedFeature& feature : seen) {
    const Prediction p = PredictFeature(static_cast<std::size_t>(feature.id), state_);
    turns_rad.push_back((feature.u_px - p.u_px) / p.du[kHeading]);
  }
  const double turned_rad = Median(turns_rad);
  for (double& turn_rad : turns_rad) turn_rad = std::abs(turn_rad - turned_rad);
  const double known_to_rad =
      std::sqrt(covariance_(kHeading, kHeading) + covariance_(kMountYaw, kMountYaw) +
                2.0 * covariance_(kHeading, kMountYaw));
  const double possible_rad = options_.knock_least_rad + options_.knock_sigmas * known_to_rad;
  if (std::abs(turned_rad) < possible_rad) return;
  if (Median(turns_rad) > options_.knock_spread * std::abs(turned_rad)) return;
  covariance_(kHeading, kHeading) += Square(turned_rad);
  if (!WasTurnedLately()) covariance_(kMountYaw, kMountYaw) += Square(turned_rad);
  turned_at_m_ = driven_m_;
  last_look_.reset();
}

Agreement PathEstimator::Update(const std::vector<route::TrackedFeature>& seen) {
  AllowForKnock(seen);
  const double came_m = std::min(driven_m_ - looked_at_m_, options_.knock_apart_m);
  usually_seen_ +=
      came_m / options_.knock_apart_m * (static_cast<double>(seen.size()) - usually_seen_);
  looked_at_m_ = driven_m_;
  const bool stands =
      last_look_ && last_look_->moved_m < kStands_m && last_look_->turned_rad < kStands_rad;
  if (!stands) last_look_ = LastLook{covariance_};
  const State predicted = state_;
  const auto rough = rough_;
  Prior prior = BeforeLook();
  if (rough_ && seen.size() >= (rough_->focal ? kFewestByKnownCamera : kFewestToFind)) {
    prior = FindWhereAlong(prior, seen);
    last_look_->before = prior.covariance;
  }
  Equations equations;
  for (int iteration = 0; iteration < kUpdateIterations; ++iteration) {
    equations = Linearise(state_, prior, seen, options_.cauchy_px);
    state_ += equations.information.ldlt().solve(equations.gradient);
  }
  if (equations.agreement.agreeing >= kFewestAgreeing) {
    covariance_ = equations.information.inverse();
  } else {
    state_ = predicted;
    rough_ = rough;
  }
  if (++looks_ % options_.carried_every_looks == 0) {
    equations.agreement.carried_left_m = FindIfCarriedOff(prior, seen);
  }
  return equations.agreement;
}

PathEstimator::Prior PathEstimator::BeforeLook() {
  State mean = state_;
  Covariance covariance = last_look_->before;
  if (!known_) return {mean, covariance};
  const double variance = covariance(kMagnification, kMagnification);
  if (driven_m_ - known_->at_m >= options_.magnification_every_m) {
    known_ = {mean[kMagnification], variance, driven_m_};
  }
  const State by_magnification = covariance.col(kMagnification) / variance;
  mean += by_magnification * (known_->mean - mean[kMagnification]);
  covariance +=
      std::max(0.0, known_->variance - variance) * by_magnification * by_magnification.transpose();
  return {mean, covariance};
}

bool PathEstimator::KnowsAhead() const {
  return options_.camera_ahead_m || Square(state_[kAhead]) > 4.0 * covariance_(kAhead, kAhead);
}

PathOffset PathEstimator::offset() const {
  const double ahead_m = state_[kAhead];
  const double along_m = state_[kAlong] - ahead_m * std::cos(state_[kHeading]);
  const double turned = TaughtTurn(along_m, state_[kAlong]);
  const double left_m = state_[kLeft] - ahead_m * (std::sin(state_[kHeading]) + 0.5 * turned);
  return {left_m, state_[kHeading] + turned, along_m, offset_sigma_m(),
          std::sqrt(covariance_(kAlong, kAlong))};
}

double PathEstimator::offset_sigma_m() const {
  const double along_m = state_[kAlong] - state_[kAhead] * std::cos(state_[kHeading]);
  Row left = Row::Zero();  // of the axle, by the state
  left[kLeft] = 1.0;
  left[kHeading] = -state_[kAhead];
  left[kAhead] = -std::sin(state_[kHeading]) - 0.5 * TaughtTurn(along_m, state_[kAlong]);
  return std::sqrt(std::max(0.0, (left * covariance_ * left.transpose()).value()));
}

std::vector<route::TrackedFeature> PathEstimator::ExpectIn(const State& state) const {
  std::vector<route::TrackedFeature> places;
  for (std::size_t i = 0; i < segment_.features.size(); ++i) {
    const Prediction p = PredictFeature(i, state);
    places.push_back({static_cast<int>(i), p.u_px, p.v_px});
  }
  return places;
}

std::vector<route::TrackedFeature> PathEstimator::ExpectAtMilestone() const {
  State there = state_;
  there[kLeft] = there[kHeading] = there[kRoll] = 0.0;
  there[kAlong] = ExitOf(segment_);
  return ExpectIn(there);
}

}  // namespace trailcast::replay
