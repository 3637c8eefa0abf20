#include "services/replay/path_follower.h"

#include <algorithm>
#include <cmath>

#include "services/replay/src/as_forward.h"

namespace trailcast::replay {
namespace {

constexpr double kSoonCurvatureStep_m = 0.05;
constexpr double kTightest = 0.5;  // share of a bend's radius
constexpr double kWidest = 2.0;
constexpr double kTurnTime_s = 0.5;  // turn_rad is the heading change over this time

}  // namespace

PathFollower::PathFollower(int scout_width_px, double magnification,
                           const PathFollowerOptions& options)
    : options_(options), estimator_(scout_width_px, magnification, options.estimator) {}

void PathFollower::Begin(const route::Segment& segment) {
  const bool next = begun_ && segment.index.value() == segment_.index.value() + 1;
  if (next) {
    estimator_.Begin(AsForward(segment));
    segment_ = segment;
  } else {
    // A robot at the route's start has its axle there.
    const bool at_start = !begun_;
    BeginAt(segment, 0.0);
    if (at_start) estimator_.StartAt(AsForward(segment));
  }
  if (segment.turn_before_rad != 0.0) estimator_.TurnPath(segment.turn_before_rad);
  turning_ = std::abs(segment.turn_before_rad) >= options_.spot_turn_least_rad;
}

void PathFollower::Learn(const route::Segment& segment) { estimator_.Learn(AsForward(segment)); }

PathOffset PathFollower::offset() const {
  PathOffset offset = estimator_.offset();
  // A guessed place of the camera would shift where the robot stops.
  offset.along_m = Driven_m(estimator_.KnowsAhead() ? offset.along_m : estimator_.camera_along_m());
  return offset;
}

void PathFollower::BeginAt(const route::Segment& segment, double fraction) {
  segment_ = segment;
  estimator_.Restart(AsForward(segment), Driven_m(fraction * segment.length_m));
  begun_ = true;
  turning_ = false;
}

void PathFollower::BeginAbout(const route::Segment& segment, double fraction,
                              const RoughPlace& rough) {
  BeginAt(segment, fraction);
  estimator_.BeUnsureWhereAlong(rough);
}

void PathFollower::CountAlong(const route::Segment& earlier, double along_m,
                              const motion::Pose2& there) {
  segment_ = earlier;
  estimator_.CountAlong(AsForward(earlier), along_m, there);
  turning_ = false;
}

void PathFollower::SetMagnification(double magnification) {
  if (!settled_) estimator_.SetMagnification(magnification);
}

FollowStep PathFollower::TurnOnTheSpot(const std::vector<route::TrackedFeature>& seen) {
  FollowStep step;
  if (static_cast<int>(seen.size()) >= options_.few_features) {
    step.agreeing = estimator_.Update(seen).agreeing;
  }
  step.offset = offset();
  step.mount_yaw_rad = estimator_.mount_yaw_rad();
  const double left_rad = -step.offset->heading_rad;
  turning_ = std::abs(left_rad) > options_.spot_turn_done_rad;
  if (!turning_) return step;
  const double rate =
      std::max(options_.spot_turn_slowest_radps, options_.spot_turn_gain_hz * std::abs(left_rad));
  step.command = motion::Limit({0.0, std::copysign(rate, left_rad)}, options_.limits);
  step.turn_rad = step.odometry_turn_rad = -step.command.angular_radps * kTurnTime_s;
  return step;
}

// Uses the bend at the place where the robot will carry the command out, but not beyond the
// segment.
double PathFollower::TurnRate(const PathOffset& along, double speed_mps, double aside_m) const {
  const double there_m = along.along_m + speed_mps * options_.base_delay_s;
  const double soon_m = segment_.reverse
                            ? std::max(there_m, 0.5 * kSoonCurvatureStep_m)
                            : std::min(there_m, segment_.length_m - 0.5 * kSoonCurvatureStep_m);
  const double taught = estimator_.TaughtTurn(soon_m - 0.5 * kSoonCurvatureStep_m,
                                              soon_m + 0.5 * kSoonCurvatureStep_m) /
                        kSoonCurvatureStep_m;
  // Beside the path a bend is wider or tighter.
  const double curvature = taught / std::clamp(1.0 - taught * aside_m, kTightest, kWidest);
  PathOffset from_lane = along;
  from_lane.left_m -= aside_m;
  return LaneKeepingTurnRate(from_lane, curvature, speed_mps, options_.lane_keeping);
}

FollowStep PathFollower::Step(const FollowInput& input) {
  if (input.odometry) estimator_.Predict(*input.odometry);
  estimator_.Widen(input.unknown);
  if (turning_) return TurnOnTheSpot(input.features);
  FollowStep step;
  const Agreement agreement = estimator_.Update(input.features);
  step.agreeing = agreement.agreeing;
  step.rejected = agreement.rejected;
  step.rejected_by_px = agreement.rejected_by_px;
  step.carried_left_m = agreement.carried_left_m;
  step.roll_rad = estimator_.roll_rad();
  step.offset = offset();
  step.mount_yaw_rad = estimator_.mount_yaw_rad();
  const double ahead_mps = options_.speed_factor * segment_.speed_mps();
  const double speed_mps = segment_.reverse ? -ahead_mps : ahead_mps;
  const double turn_rate =
      TurnRate(estimator_.offset(), estimator_.WayScale() * speed_mps, input.aside_m) /
      estimator_.TurnScale();
  step.command = motion::Limit({speed_mps, turn_rate}, options_.limits);
  step.turn_rad = -turn_rate * kTurnTime_s;
  const double driven_m = Driven_m(estimator_.camera_along_m());
  step.fraction =
      segment_.length_m > 0.0 ? std::clamp(driven_m / segment_.length_m, 0.0, 1.0) : 1.0;
  step.ended = driven_m >= segment_.length_m;
  step.wants_next =
      step.fraction > options_.early_fraction && step.agreeing < options_.few_features;
  settled_ = settled_ || step.agreeing >= options_.few_features;
  return step;
}

}  // namespace trailcast::replay
