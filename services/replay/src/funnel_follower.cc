#include "services/replay/funnel_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/base/square.h"
#include "services/replay/src/track_progress.h"
#include "services/route/heading.h"
#include "services/route/track.h"
#include "services/route/usual_camera.h"

namespace trailcast::replay {
namespace {

constexpr std::size_t kFractionMedian = 3;

using Points = std::vector<Eigen::Vector2d>;

Eigen::Vector2d Place(const route::TrackKnot& knot) { return {knot.u_px, knot.v_px}; }

// This uses the x-coordinates: y counts for roll alone (III), and a robot that pitches moves all of
// them.
double MeanSquared(const Points& a, const Points& b) {
  if (a.empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += Square(a[i].x() - b[i].x());
  return sum / static_cast<double>(a.size());
}

double RollTowards(const Points& points, const Points& towards, const RollOptions& options) {
  std::vector<ImagePair> pairs;
  for (std::size_t i = 0; i < points.size(); ++i) pairs.push_back({points[i], towards[i]});
  return EstimateRoll(pairs, options).angle_rad;
}

Points Unrolled(Points points, double angle_rad) {
  for (Eigen::Vector2d& point : points) point = Unroll(point, angle_rad);
  return points;
}

}  // namespace

// These are the features in view beside their stored places, in pixels of the scout's
// magnification, at one position in each list. Two images are compared without the roll between
// them.
struct FunnelFollower::Matched {
  std::vector<int> id;
  Points current;
  Points current_as_first;  // unrolled towards the segment's first image, the previous milestone
  Points first;
  Points first_as_milestone;
  Points milestone;
  double roll_rad = 0.0;  // of the robot now, relative to the milestone

  void UndoRoll(const RollOptions& options) {
    current_as_first = Unrolled(current, RollTowards(current, first, options));
    first_as_milestone = Unrolled(first, RollTowards(first, milestone, options));
    roll_rad = RollTowards(current, milestone, options);
    current = Unrolled(current, roll_rad);
  }
  [[nodiscard]] std::vector<route::TrackedFeature> Features() const {
    std::vector<route::TrackedFeature> features;
    for (std::size_t i = 0; i < current.size(); ++i) {
      features.push_back({id[i], current[i].x(), current[i].y()});
    }
    return features;
  }
  [[nodiscard]] std::vector<FunnelPair> FunnelPairs() const {
    std::vector<FunnelPair> pairs;
    for (std::size_t i = 0; i < current.size(); ++i) {
      pairs.push_back({current[i].x(), milestone[i].x()});
    }
    return pairs;
  }
};

FunnelFollower::FunnelFollower(int scout_width_px, double magnification,
                               const FunnelFollowerOptions& options)
    : options_(options),
      gain_rad_per_px_(options.gain_rad_per_px_at_320 * 320.0 / scout_width_px),
      min_feature_sigma_px_(options.min_feature_sigma_px_at_320 * scout_width_px / 320.0),
      magnification_(magnification),
      transition_(options.transition),
      visual_fraction_(kFractionMedian) {}

void FunnelFollower::Begin(const route::Segment& segment) {
  // The last segment ended where delta was highest, so the motion since then belongs to this one.
  if (begun_ && segment.index.value() == segment_.index.value() + 1) {
    driven_.distance_m -= driven_at_peak_.distance_m;
    driven_.heading_change_rad -= driven_at_peak_.heading_change_rad;
  } else {
    driven_ = {};
  }
  driven_lately_.clear();
  driven_at_peak_ = {};
  segment_ = segment;
  transition_ = TransitionDetector(options_.transition);
  visual_fraction_ = MedianFilter(kFractionMedian);
  fraction_ = 0.0;
  begun_ = true;
}

void FunnelFollower::BeginAt(const route::Segment& segment, double fraction) {
  begun_ = false;
  Begin(segment);
  driven_.distance_m = fraction * segment.length_m;
  driven_.heading_change_rad = route::HeadingAt(segment.heading, driven_.distance_m);
  fraction_ = fraction;
}

std::vector<route::TrackedFeature> FunnelFollower::ExpectAt(double fraction) const {
  std::vector<route::TrackedFeature> places;
  for (std::size_t i = 0; i < segment_.features.size(); ++i) {
    const route::TrackKnot taught = route::TaughtPlace(segment_.features[i], fraction);
    places.push_back(
        {static_cast<int>(i), magnification_ * taught.u_px, magnification_ * taught.v_px});
  }
  return places;
}

FunnelFollower::Matched FunnelFollower::Match(
    const std::vector<route::TrackedFeature>& features) const {
  Matched matched;
  for (const route::TrackedFeature& feature : features) {
    const route::Feature& stored = segment_.features.at(static_cast<std::size_t>(feature.id));
    matched.id.push_back(feature.id);
    matched.current.emplace_back(feature.u_px / magnification_, feature.v_px / magnification_);
    matched.first.push_back(Place(stored.first()));
    matched.milestone.push_back(Place(stored.milestone()));
  }
  matched.current_as_first = matched.current;
  matched.first_as_milestone = matched.first;
  return matched;
}

FollowStep FunnelFollower::Step(const FollowInput& input) {
  if (input.odometry) {
    driven_.distance_m += input.odometry->distance_m;
    driven_.heading_change_rad += input.odometry->heading_change_rad;
  }
  const bool by_odometry = input.odometry && segment_.has_odometry;
  const double speed_mps =
      segment_.has_odometry ? options_.speed_factor * segment_.speed_mps() : route::kUsualSpeed_mps;
  FollowStep step;
  Matched matched = Match(input.features);
  if (options_.compensate_roll) matched.UndoRoll(options_.roll);
  step.roll_rad = matched.roll_rad;

  // This is equation (1): the funnel lane fused with the taught heading, or each half alone if the
  // other is missing.
  step.vision_turn_rad = VisionTurn(matched);
  step.odometry_turn_rad = by_odometry ? OdometryTurn(speed_mps) : 0.0;
  const double eta = !by_odometry ? 1.0 : matched.current.empty() ? 0.0 : options_.eta;
  step.turn_rad = FuseTurns(step.vision_turn_rad, step.odometry_turn_rad, eta);

  step.agreeing = static_cast<int>(matched.current.size());
  step.ended = Ended(matched, by_odometry, step);
  step.command = motion::Limit({speed_mps, -step.turn_rad / options_.turn_time_s}, options_.limits);
  return step;
}

double FunnelFollower::VisionTurn(const Matched& matched) const {
  if (options_.bang_bang_radps > 0.0) {
    return MajorityTurn(matched.FunnelPairs()) * options_.bang_bang_radps * options_.turn_time_s;
  }
  return MeanFeatureTurn(matched.FunnelPairs(), gain_rad_per_px_);
}

// This is equation (2), against this milestone and against the previous one, which is the image
// that the segment began with.
bool FunnelFollower::Ended(const Matched& matched, bool by_odometry, FollowStep& step) {
  TransitionErrors errors = by_odometry ? OdometryErrors() : TransitionErrors{};
  errors.feature_sigma_px = std::max(
      min_feature_sigma_px_, std::sqrt(MeanSquared(matched.first_as_milestone, matched.milestone)));
  errors.feature_px2 = MeanSquared(matched.current_as_first, matched.first);
  const double delta_minus = EndProbability(errors);
  errors.feature_px2 = MeanSquared(matched.current, matched.milestone);
  const double delta = EndProbability(errors);
  const bool fallen = transition_.Add(delta, delta_minus);
  driven_lately_.push_back(driven_);
  if (driven_lately_.size() > options_.transition.median_length) driven_lately_.pop_front();
  if (transition_.at_peak()) driven_at_peak_ = driven_lately_[(driven_lately_.size() - 1) / 2];
  step.delta = transition_.delta();
  step.delta_minus = transition_.delta_minus();
  step.fraction = fraction_ = Fraction(matched, by_odometry);
  const double longest_m = segment_.length_m * (1.0 + options_.overrun_share) + options_.overrun_m;
  if (by_odometry) return fallen || driven_.distance_m > longest_m;
  return TellsProgress(matched) && (fallen || fraction_ >= options_.end_fraction_without_odometry);
}

double FunnelFollower::OdometryTurn(double speed_mps) const {
  const double ahead_m = driven_.distance_m + speed_mps * options_.turn_time_s;
  const double asked_rad =
      route::HeadingAt(segment_.heading, std::clamp(ahead_m, 0.0, segment_.length_m));
  return driven_.heading_change_rad - asked_rad;  // too far left asks for a turn to the right
}

TransitionErrors FunnelFollower::OdometryErrors() const {
  TransitionErrors errors;
  errors.distance_m2 = std::pow(driven_.distance_m - segment_.length_m, 2);
  errors.distance_sigma_m = std::max(options_.min_distance_sigma_m, segment_.length_m);
  errors.heading_rad2 = std::pow(driven_.heading_change_rad - segment_.heading_change_rad, 2);
  errors.heading_sigma_rad =
      std::max(options_.min_heading_sigma_rad, segment_.heading_variation_rad);
  return errors;
}

bool FunnelFollower::TellsProgress(const Matched& matched) const {
  const double stored = static_cast<double>(segment_.features.size());
  const double least = std::max(1.0, std::floor(options_.share_to_tell_progress * stored));
  return static_cast<double>(matched.current.size()) >= least;
}

double FunnelFollower::Fraction(const Matched& matched, bool by_odometry) {
  if (by_odometry) {
    return segment_.length_m > 0.0 ? std::clamp(driven_.distance_m / segment_.length_m, 0.0, 1.0)
                                   : 1.0;
  }
  if (!TellsProgress(matched)) return fraction_;
  const double seen = EstimateProgress(segment_, matched.Features()).fraction;
  return std::min(1.0, visual_fraction_.Add(seen));
}

}  // namespace trailcast::replay
