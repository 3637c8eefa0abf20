#include "services/replay/segment_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/replay/track_progress.h"
#include "services/route/heading.h"

namespace trailcast::replay {
namespace {

// Robots without odometry are told a speed all the same: a walking pace that any of them can do.
constexpr double kSpeedWithoutOdometry_mps = 0.3;

Eigen::Vector2d Place(const route::TrackKnot& knot) { return {knot.u_px, knot.v_px}; }

double MeanSquared(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  if (a.empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return sum / static_cast<double>(a.size());
}

}  // namespace

// The features in view beside their stored places, one position in each list for a feature.
struct SegmentFollower::Matched {
  std::vector<route::TrackedFeature> features;  // as given, roll undone
  std::vector<Eigen::Vector2d> current;
  std::vector<Eigen::Vector2d> first;
  std::vector<Eigen::Vector2d> milestone;

  void UndoRoll(double angle_rad) {
    for (std::size_t i = 0; i < current.size(); ++i) {
      current[i] = Unroll(current[i], angle_rad);
      features[i].u_px = current[i].x();
      features[i].v_px = current[i].y();
    }
  }
  [[nodiscard]] std::vector<ImagePair> AgainstMilestone() const {
    std::vector<ImagePair> pairs;
    for (std::size_t i = 0; i < current.size(); ++i) pairs.push_back({current[i], milestone[i]});
    return pairs;
  }
  [[nodiscard]] std::vector<FunnelPair> FunnelPairs() const {
    std::vector<FunnelPair> pairs;
    for (std::size_t i = 0; i < current.size(); ++i) {
      pairs.push_back({current[i].x(), milestone[i].x()});
    }
    return pairs;
  }
};

SegmentFollower::SegmentFollower(route::Segment segment, int image_width_px,
                                 const SegmentFollowerOptions& options,
                                 const motion::OdometryIncrement& start)
    : segment_(std::move(segment)),
      options_(options),
      gain_rad_per_px_(options.gain_rad_per_px_at_320 * 320.0 / image_width_px),
      driven_(start),
      transition_(options.transition) {}

SegmentFollower::Matched SegmentFollower::Match(
    const std::vector<route::TrackedFeature>& features) const {
  Matched matched;
  matched.features = features;
  for (const route::TrackedFeature& feature : features) {
    const route::Feature& stored = segment_.features.at(static_cast<std::size_t>(feature.id));
    matched.current.emplace_back(feature.u_px, feature.v_px);
    matched.first.push_back(Place(stored.first()));
    matched.milestone.push_back(Place(stored.milestone()));
  }
  return matched;
}

FollowStep SegmentFollower::Step(const FollowInput& input) {
  if (input.odometry) {
    driven_.distance_m += input.odometry->distance_m;
    driven_.heading_change_rad += input.odometry->heading_change_rad;
  }
  const bool by_odometry = input.odometry && segment_.has_odometry;
  const double speed_mps = segment_.has_odometry ? options_.speed_factor * segment_.speed_mps()
                                                 : kSpeedWithoutOdometry_mps;
  FollowStep step;
  Matched matched = Match(input.features);
  step.roll_rad = EstimateRoll(matched.AgainstMilestone(), options_.roll).angle_rad;
  matched.UndoRoll(step.roll_rad);

  // The funnel lane, fused with the taught heading: equation (1). Each half alone where the other
  // is missing.
  step.vision_turn_rad = MeanFeatureTurn(matched.FunnelPairs(), gain_rad_per_px_);
  step.odometry_turn_rad = by_odometry ? OdometryTurn(speed_mps) : 0.0;
  const double eta = !by_odometry ? 1.0 : matched.current.empty() ? 0.0 : options_.eta;
  step.turn_rad = FuseTurns(step.vision_turn_rad, step.odometry_turn_rad, eta);

  // At the segment's end? Equation (2), against this milestone and against the previous one, which
  // is the image that the segment began with.
  TransitionErrors errors = by_odometry ? OdometryErrors() : TransitionErrors{};
  errors.feature_sigma_px = std::sqrt(MeanSquared(matched.first, matched.milestone));
  errors.feature_px2 = MeanSquared(matched.current, matched.first);
  const double delta_minus = EndProbability(errors);
  errors.feature_px2 = MeanSquared(matched.current, matched.milestone);
  const double delta = EndProbability(errors);
  step.ended = transition_.Add(delta, delta_minus, driven_.distance_m);
  step.delta = transition_.delta();
  step.delta_minus = transition_.delta_minus();
  step.fraction = Fraction(matched, by_odometry);
  step.ended |= !by_odometry && step.fraction >= options_.end_fraction_without_odometry;

  step.command = motion::Limit({speed_mps, -step.turn_rad / options_.turn_time_s}, options_.limits);
  return step;
}

double SegmentFollower::OdometryTurn(double speed_mps) const {
  const double ahead_m = driven_.distance_m + speed_mps * options_.turn_time_s;
  const double asked_rad =
      route::HeadingAt(segment_.heading, std::clamp(ahead_m, 0.0, segment_.length_m));
  return driven_.heading_change_rad - asked_rad;  // too far left asks for a turn to the right
}

TransitionErrors SegmentFollower::OdometryErrors() const {
  TransitionErrors errors;
  errors.distance_m2 = std::pow(driven_.distance_m - segment_.length_m, 2);
  errors.distance_sigma_m = std::max(options_.min_distance_sigma_m, segment_.length_m);
  errors.heading_rad2 = std::pow(driven_.heading_change_rad - segment_.heading_change_rad, 2);
  errors.heading_sigma_rad =
      std::max(options_.min_heading_sigma_rad, segment_.heading_variation_rad);
  return errors;
}

double SegmentFollower::Fraction(const Matched& matched, bool by_odometry) {
  if (by_odometry) {
    return segment_.length_m > 0.0 ? std::clamp(driven_.distance_m / segment_.length_m, 0.0, 1.0)
                                   : 1.0;
  }
  if (matched.features.empty()) return 0.0;
  const double seen = EstimateProgress(segment_, matched.features).fraction;
  return std::min(1.0, visual_fraction_.Add(seen));
}

double SegmentFollower::overshoot_m() const {
  return std::max(0.0, driven_.distance_m - transition_.distance_at_peak_m());
}

}  // namespace trailcast::replay
