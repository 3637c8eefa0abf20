// This reports a step, and decides how much of it is driven.
#include <algorithm>
#include <cmath>

#include "agent/session/src/route_follower.h"

namespace trailcast::agent {
namespace {

constexpr double kUncertainSpeedFactor = 0.6;
// A robot approaches a place where it has to stand ever more slowly: the route's end, a turn on the
// spot, and a change to the other direction.
constexpr double kEndDeceleration_mps2 = 0.25;
constexpr double kEndSpeed_mps = 0.08;

// Returns the share of the method's speed that is driven: less than all of it if the place beside
// the path is not known well, and before the robot has to stand.
double SpeedShare(const Next& next, const route::Segment& segment, bool stands_after) {
  const Trust trust = next.verdict.trust;
  const double share =
      trust == Trust::kBlind || trust == Trust::kDistant ? kUncertainSpeedFactor : 1.0;
  const double speed_mps = std::abs(next.step.command.linear_mps);
  if (!stands_after || speed_mps == 0.0) return share;
  const double left_m = (1.0 - next.step.fraction) * segment.length_m;
  const double bound_mps = kEndSpeed_mps + std::sqrt(2.0 * kEndDeceleration_mps2 * left_m);
  return std::min(share, bound_mps / speed_mps);
}

}  // namespace

ReplayStep RouteFollower::ReportOf(const Verdict& verdict, ReplayState state) const {
  ReplayStep report;
  report.state = state;
  report.trust = verdict.trust;
  report.reason = verdict.reason;
  report.sight = {0, front_end_.tracker().losses(), search_.searches()};
  report.found_share = search_.hand_over().found_share();
  report.hand_overs = search_.hand_over().count();
  report.features = front_end_.tracker().count();
  return report;
}

ReplayStep RouteFollower::Report(const Next& next) const {
  const auto& step = next.step;
  const ReplayState state = next.state();
  ReplayStep report = ReportOf(next.verdict, state);
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
  const bool on_by_odometry = next.verdict.trust == Trust::kBlind && front_end_.knows_motion() &&
                              UsesOdometry(options_.method);
  const bool moves_blindly =
      state == ReplayState::kBlind && (on_by_odometry || look_around_.turns());
  if (state == ReplayState::kFollowing || moves_blindly) {
    const bool stands_after = !AsPrinted(options_.method) && route_.stands_after(segment.index);
    const double share = SpeedShare(next, segment, stands_after);
    report.command = {share * step.command.linear_mps, share * step.command.angular_radps};
  }
  return report;
}

}  // namespace trailcast::agent
