#include "services/replay/taught_flow.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "services/base/median.h"
#include "services/base/square.h"
#include "services/route/heading.h"

namespace trailcast::replay {
namespace {

// Below this, the flow of a turn is equal all over the picture.
constexpr double kLeastWidening = 1e-4;
// A turn by more than this takes a feature out of the camera's half of the world.
constexpr double kSideways_rad = 1.4;

constexpr int kFlowIterations = 6;
constexpr int kFitsBeforeNoise = 2;  // then residuals are noise
constexpr double kNearest_m = 0.3;   // beyond the segment's end; nothing nearer is ever in view
constexpr double kCauchySigmas = 3.0;
constexpr double kSmallestShrink = 0.05;
constexpr std::size_t kFewestWithASpread = 5;
constexpr double kMedianOfUnit = 1.18;  // median length of vectors with unit noise in u and in v
constexpr std::size_t kFewestToTellNoise = 20;
// No number of bends tells it better, since their odometry has errors.
constexpr double kLeastFocalSigma = 0.04;

}  // namespace

double InverseDepth::At(double along_m) const {
  return at_start_per_m / std::max(kSmallestShrink, 1.0 - at_start_per_m * along_m);
}

double InverseDepth::Growth(double from_m, double to_m) const {
  return std::max(kSmallestShrink, 1.0 - at_start_per_m * from_m) /
         std::max(kSmallestShrink, 1.0 - at_start_per_m * to_m);
}

void DrawTogether(std::vector<InverseDepth>& depths) {
  if (depths.size() < kFewestWithASpread) return;
  double weights = 0.0;
  double mean_per_m = 0.0;
  for (const InverseDepth& depth : depths) {
    const double weight = 1.0 / Square(depth.sigma_per_m);
    weights += weight;
    mean_per_m += (depth.at_start_per_m - mean_per_m) * weight / weights;
  }
  // The sure ones tell the spread. The square of the weight makes its noise least.
  double excess = 0.0;
  double squares = 0.0;
  for (const InverseDepth& depth : depths) {
    const double variance = Square(depth.sigma_per_m);
    excess +=
        (Square(depth.at_start_per_m - mean_per_m) - variance + 1.0 / weights) / Square(variance);
    squares += 1.0 / Square(variance);
  }
  const double spread = std::max(0.0, excess / squares);
  for (InverseDepth& depth : depths) {
    const double variance = Square(depth.sigma_per_m);
    const double kept = spread / (spread + variance);
    depth.at_start_per_m = mean_per_m + kept * (depth.at_start_per_m - mean_per_m);
    depth.sigma_per_m = std::sqrt(kept * variance + Square(1.0 - kept) / weights);
  }
}

// This is one landmark's share of the normal equations: of the common unknowns, of its own inverse
// depth, and between the two.
struct TaughtFlow::Equations {
  Matrix common = Matrix::Zero();
  Vector common_gradient = Vector::Zero();
  Vector mixed = Vector::Zero();
  double depth = 1e-6;
  double depth_gradient = 0.0;

  void Add(const Vector& slope, double depth_slope, double residual, double weight) {
    common += weight * slope * slope.transpose();
    common_gradient += weight * residual * slope;
    mixed += weight * depth_slope * slope;
    depth += weight * depth_slope * depth_slope;
    depth_gradient += weight * depth_slope * residual;
  }
};

Eigen::Vector2d ScoutCamera::Turned(const Eigen::Vector2d& place, double turn_rad) const {
  const double root = std::sqrt(std::max(kLeastWidening, widening));
  const double from_rad = std::atan(root * place.x() / focal_px);
  const double to_rad = std::clamp(from_rad + root * turn_rad, -kSideways_rad, kSideways_rad);
  return {focal_px / root * std::tan(to_rad), place.y() * std::cos(from_rad) / std::cos(to_rad)};
}

TaughtFlow::TaughtFlow(int scout_width_px, const TaughtFlowOptions& options)
    : options_(options), noise_px_(options.track_noise_px_at_320 * scout_width_px / 320.0) {
  const double focal_px = options.focal_share * scout_width_px;
  mean_ << 0.0, 0.0, std::log(focal_px), options.widening;
  CameraVector sigma;
  sigma << focal_px * options.mount_sigma_rad, focal_px * options.mount_sigma_rad,
      options.focal_sigma, options.widening_sigma;
  information_ = sigma.cwiseProduct(sigma).cwiseInverse().asDiagonal();
  Use(mean_);
}

void TaughtFlow::Use(const CameraVector& camera) {
  camera_.ahead_u_px = camera[kAheadU];
  camera_.ahead_v_px = camera[kAheadV];
  camera_.focal_px = std::exp(camera[kLogFocal]);
  camera_.widening = camera[kWidening];
}

TaughtFlow::HeadingVector TaughtFlow::BetweenQuarters(double s) {
  HeadingVector share = HeadingVector::Zero();
  const double quarters = std::clamp(s, 0.0, 1.0) * kHeading;
  const int after = std::min(static_cast<int>(quarters), kHeading - 1);
  share[after] = quarters - after;
  if (after > 0) share[after - 1] = 1.0 - share[after];
  return share;
}

TaughtFlow::Landmark TaughtFlow::MakeLandmark(const route::Segment& segment,
                                              const route::Feature& feature) {
  Landmark landmark;
  for (std::size_t i = 1; i < feature.track.size(); ++i) {
    const route::TrackKnot& a = feature.track[i - 1];
    const route::TrackKnot& b = feature.track[i];
    const double from_m = a.s * segment.length_m;
    const double to_m = b.s * segment.length_m;
    landmark.stretches.push_back(
        {0.5 * (from_m + to_m), to_m - from_m,
         route::HeadingAt(segment.heading, to_m) - route::HeadingAt(segment.heading, from_m),
         BetweenQuarters(b.s) - BetweenQuarters(a.s), 0.5 * (a.u_px + b.u_px),
         0.5 * (a.v_px + b.v_px), b.u_px - a.u_px, b.v_px - a.v_px});
  }
  return landmark;
}

TaughtFlow::Flow TaughtFlow::FlowOf(const Stretch& stretch, const InverseDepth& depth,
                                    const Vector& unknowns) {
  const double f = std::exp(unknowns[kLogFocal]);
  const double c = unknowns[kWidening];
  Flow flow;
  flow.turn_rad = stretch.turn_rad + stretch.turn_error.dot(unknowns.tail<kHeading>());
  flow.wide = stretch.u_px / f * Eigen::Vector2d(stretch.u_px, stretch.v_px);
  flow.out = {stretch.u_px - unknowns[kAheadU], stretch.v_px - unknowns[kAheadV]};
  flow.nearer = depth.At(stretch.middle_m) * stretch.length_m;
  flow.residual = Eigen::Vector2d(stretch.du_px, stretch.dv_px) -
                  flow.turn_rad * (Eigen::Vector2d(f, 0.0) + c * flow.wide) -
                  flow.nearer * flow.out;
  return flow;
}

TaughtFlow::Equations TaughtFlow::Linearise(const Landmark& landmark, const Fit& fit) {
  Equations equations;
  const double f = std::exp(fit.unknowns[kLogFocal]);
  const double c = fit.unknowns[kWidening];
  for (const Stretch& s : landmark.stretches) {
    const auto [turn, wide, out, nearer, residual] = FlowOf(s, landmark.depth, fit.unknowns);
    const double shrink =
        std::max(kSmallestShrink, 1.0 - landmark.depth.at_start_per_m * s.middle_m);
    const double error2 = residual.squaredNorm() / Square(fit.noise_px);
    const double weight = 1.0 / (Square(fit.noise_px) * (1.0 + error2 / Square(kCauchySigmas)));
    Vector slope_u;
    slope_u << -nearer, 0.0, turn * (f - c * wide.x()), turn * wide.x(),
        (f + c * wide.x()) * s.turn_error;
    Vector slope_v;
    slope_v << 0.0, -nearer, -turn * c * wide.y(), turn * wide.y(), c * wide.y() * s.turn_error;
    const double depth_slope = s.length_m / Square(shrink);
    equations.Add(slope_u, depth_slope * out.x(), residual.x(), weight);
    equations.Add(slope_v, depth_slope * out.y(), residual.y(), weight);
  }
  return equations;
}

double TaughtFlow::NoiseOf(const Fit& fit) const {
  std::vector<double> off_px;
  for (const Landmark& landmark : fit.landmarks) {
    for (const Stretch& stretch : landmark.stretches) {
      off_px.push_back(FlowOf(stretch, landmark.depth, fit.unknowns).residual.norm());
    }
  }
  if (off_px.size() < kFewestToTellNoise) return noise_px_;
  return std::max(noise_px_, options_.noise_together * Median(std::move(off_px)) / kMedianOfUnit);
}

// This is one step of Gauss-Newton. The depths are eliminated first and follow from the rest.
void TaughtFlow::Improve(Fit& fit, double length_m) const {
  Matrix& information = fit.information;
  information.setZero();
  information.topLeftCorner<kCamera, kCamera>() = information_;
  information.bottomRightCorner<kHeading, kHeading>().diagonal().setConstant(
      1.0 / Square(options_.heading_error_rad));
  Vector prior = Vector::Zero();
  prior.head<kCamera>() = mean_;
  Vector gradient = information * (prior - fit.unknowns);
  std::vector<Equations> all;
  all.reserve(fit.landmarks.size());
  for (const Landmark& landmark : fit.landmarks) {
    const Equations& e = all.emplace_back(Linearise(landmark, fit));
    information += e.common - e.mixed * e.mixed.transpose() / e.depth;
    gradient += e.common_gradient - e.mixed * (e.depth_gradient / e.depth);
  }
  const Vector step = information.ldlt().solve(gradient);
  fit.unknowns += step;
  const Matrix covariance = information.inverse();
  const double largest_per_m = 1.0 / (length_m + kNearest_m);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Equations& e = all[i];
    InverseDepth& depth = fit.landmarks[i].depth;
    const double change = (e.depth_gradient - e.mixed.dot(step)) / e.depth;
    depth.at_start_per_m = std::clamp(depth.at_start_per_m + change, 0.0, largest_per_m);
    const double variance = 1.0 / e.depth + e.mixed.dot(covariance * e.mixed) / Square(e.depth);
    depth.sigma_per_m = std::sqrt(variance);
  }
}

TaughtFlow::Fit TaughtFlow::FitTo(const route::Segment& segment, Noise noise) const {
  Fit fit;
  fit.landmarks.reserve(segment.features.size());
  for (const route::Feature& feature : segment.features) {
    fit.landmarks.push_back(MakeLandmark(segment, feature));
  }
  fit.unknowns.head<kCamera>() = mean_;
  fit.noise_px = noise_px_;
  for (int i = 0; i < kFlowIterations; ++i) {
    if (noise == Noise::kAsMeasured && i >= kFitsBeforeNoise) fit.noise_px = NoiseOf(fit);
    Improve(fit, segment.length_m);
  }
  return fit;
}

void TaughtFlow::Learn(const route::Segment& segment) {
  const Fit fit = FitTo(segment, Noise::kAsMeasured);
  if (!fit.unknowns.allFinite()) return;
  // The error of the segment's own heading is not needed any more.
  const Eigen::Matrix<double, kCamera, kHeading> mixed =
      fit.information.topRightCorner<kCamera, kHeading>();
  const Eigen::Matrix<double, kHeading, kHeading> own =
      fit.information.bottomRightCorner<kHeading, kHeading>();
  mean_ = fit.unknowns.head<kCamera>();
  information_ =
      fit.information.topLeftCorner<kCamera, kCamera>() - mixed * own.inverse() * mixed.transpose();
  Use(mean_);
}

FocalLength TaughtFlow::focal() const {
  const double variance = information_.inverse()(kLogFocal, kLogFocal);
  return {camera_.focal_px, std::hypot(std::sqrt(variance), kLeastFocalSigma)};
}

std::vector<InverseDepth> TaughtFlow::Depths(const route::Segment& segment) const {
  std::vector<InverseDepth> depths;
  depths.reserve(segment.features.size());
  for (const Landmark& landmark : FitTo(segment, Noise::kOfTracker).landmarks)
    depths.push_back(landmark.depth);
  DrawTogether(depths);
  return depths;
}

}  // namespace trailcast::replay
