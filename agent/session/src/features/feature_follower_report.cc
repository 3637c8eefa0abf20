// This reports a step, and decides how much of it is driven.
#include <algorithm>
#include <cmath>

#include "agent/session/src/features/feature_follower.h"

namespace trailcast::agent {
namespace {

constexpr double kUncertainSpeedFactor = 0.6;
// A robot approaches a place where it has to stand ever more slowly: the route's end, a turn on the
// spot, and a change to the other direction.
constexpr double kEndDeceleration_mps2 = 0.25;
constexpr double kEndSpeed_mps = 0.08;

}  // namespace

// Returns less than all of it if the place beside the path is not known well, and before the robot
// has to stand.
double FeatureFollower::SpeedShare(const replay::FollowStep& step, Trust trust) const {
  const double share =
      trust == Trust::kBlind || trust == Trust::kDistant ? kUncertainSpeedFactor : 1.0;
  const route::Segment& segment = follower_->segment();
  if (AsPrinted(options_.method) || !route_.stands_after(segment.index) ||
      step.command.linear_mps == 0.0) {
    return share;
  }
  const double left_m = (1.0 - step.fraction) * segment.length_m;
  const double bound_mps = kEndSpeed_mps + std::sqrt(2.0 * kEndDeceleration_mps2 * left_m);
  return std::min(share, bound_mps / std::abs(step.command.linear_mps));
}

ReplayStep FeatureFollower::Report(const replay::FollowStep& step, const Standing& standing) const {
  const ReplayState state = standing.state;
  ReplayStep report;
  report.state = state;
  report.trust = standing.trust;
  report.sight = {0, front_end_.tracker().losses(), search_.searches()};
  report.reason = standing.reason;
  report.found_share = search_.hand_over().found_share();
  report.hand_overs = search_.hand_over().count();
  report.features = front_end_.tracker().count();
  if (!follower_) {
    report.command = step.command;
    return report;
  }
  const route::Segment& segment = follower_->segment();
  report.segment = segment.index;
  report.sight.stored = static_cast<int>(segment.features.size());
  report.magnification = follower_->magnification();
  report.fraction = state == ReplayState::kArrived ? 1.0 : step.fraction;
  report.progress = route_.ProgressAt(report.segment, report.fraction);
  if (confidence_.ever_sure() && place_.metric()) {
    // A segment's start may still be ahead, since its features are followed as soon as they are in
    // view.
    const double along_m = step.offset ? std::min(step.offset->along_m, segment.length_m)
                                       : report.fraction * segment.length_m;
    report.along_m = std::max(0.0, route_.begin_m(segment.index) + along_m);
    if (state == ReplayState::kArrived) report.along_m = route_.length_m();
  }
  report.turn_rad = step.turn_rad;
  report.passing = passing_.says();
  report.decision = step;
  const bool on_by_odometry =
      state == ReplayState::kBlind && standing.trust == Trust::kBlind && by_odometry();
  const bool looks_around = state == ReplayState::kBlind && look_around_.turns();
  if (state == ReplayState::kFollowing || on_by_odometry || looks_around) {
    const double share = SpeedShare(step, standing.trust);
    report.command = {share * step.command.linear_mps, share * step.command.angular_radps};
  }
  return report;
}

}  // namespace trailcast::agent
