#include "agent/session/src/place/view_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "services/replay/follower.h"
#include "services/route/usual_camera.h"

namespace trailcast::agent {
namespace {

// These are in the route's units, if they are not metres, and in metres.
constexpr double kLookAhead = 0.2;
constexpr double kLookAhead_m = 0.3;
constexpr double kArrived = 0.06;
constexpr double kArrived_m = 0.15;
constexpr double kCome = 1.0;
constexpr double kCome_m = 0.5;
constexpr double kTurn_m = 0.3;      // the robot stands this far before a turn
constexpr double kTurnTime_s = 0.3;  // duration of a turn
constexpr const char* kTurn =
    "the route turns on the spot here, and this robot has no odometry to tell how far it is round: "
    "only a robot with odometry follows it from here";
constexpr const char* kReverse =
    "the route is driven backwards here, and this robot has no odometry to do so by: only a robot "
    "with odometry follows it from here";
constexpr const char* kOnlyTheEnd =
    "what is seen looks like the route's end, where the robot was put and has not come by itself: "
    "put it further back";

// Returns what was recognised, in the scout's pixels at the scout's magnification.
std::vector<replay::SeenKeyView> SeenFrom(const Localiser& place, const Look& look) {
  const double half_px = 0.5 * place.recogniser().scout_width_px();
  std::vector<replay::SeenKeyView> seen;
  for (const Look::Recognised& each : look.views) {
    replay::SeenKeyView& view = seen.emplace_back();
    view.along = place.belief().view_at(each.view);
    for (const view::Comparison::Pair& pair : each.comparison.pairs) {
      view.pairs.push_back({half_px * look.seen.u[pair.seen] / each.comparison.scale,
                            half_px * place.recogniser().key(each.view).u[pair.key]});
    }
  }
  return seen;
}

}  // namespace

ViewSteering SteerByViews(const Localiser& place, double speed_mps,
                          const motion::VelocityLimits& limits) {
  const double ahead = place.metric() ? kLookAhead_m : kLookAhead;
  const replay::ViewTurn turn =
      replay::TurnTowards(place.where().along + ahead, SeenFrom(place, place.look()),
                          place.recogniser().scout_width_px());
  return {turn, motion::Limit({speed_mps, -turn.turn_rad / kTurnTime_s}, limits)};
}

bool ViewFollower::SeesTheEnd() const {
  const double tolerance = place_.metric() ? kArrived_m : kArrived;
  return place_.where().held && place_.where().along >= place_.belief().length() - tolerance;
}

bool ViewFollower::HasCome() const {
  return place_.where().come >=
         std::min(place_.metric() ? kCome_m : kCome, 0.5 * place_.belief().length());
}

// Returns what comes, at the place or shortly after, that key views cannot steer through. In a turn
// on the spot all views are of one place, whatever their direction, and none tells where to go. On
// a part that is driven backwards they ask for the wrong turn.
std::string_view ViewFollower::DoesNotDrive() const {
  if (!place_.where().held) return "";
  const RoutePoint point = place_.point();
  if (route_.segment(point.segment).reverse) return kReverse;
  const RoutePoint next{SegmentIndex(point.segment.value() + 1), 0.0};
  if (!route_.has(next.segment.value()) || place_.AlongOf(next) - place_.where().along >= kTurn_m) {
    return "";
  }
  if (route_.segment(next.segment).reverse) return kReverse;
  return std::abs(route_.turn_after_rad(point.segment)) > kTurnsAway_rad ? kTurn : "";
}

std::string_view ViewFollower::Doubt() const {
  if (const std::string_view what = DoesNotDrive(); !what.empty()) return what;
  return route_.complete() && SeesTheEnd() && !HasCome() ? kOnlyTheEnd : "";
}

// `doubt` is a reason against driving on although the place is held, or empty.
ReplayStep ViewFollower::Go(double dt_s, std::string_view doubt) {
  const belief::RouteBelief::Place& where = place_.where();
  Verdict verdict = trust_.Judge(where, dt_s, doubt);
  const RoutePoint point = place_.point();
  const route::Segment& here = route_.segment(point.segment);
  const double speed_mps = here.has_odometry ? here.speed_mps() : route::kUsualSpeed_mps;
  const ViewSteering steering =
      SteerByViews(place_, options_.speed_factor * speed_mps, options_.limits);
  ReplayStep step;
  step.state = StateOf(verdict.trust);
  step.trust = verdict.trust;
  step.reason = std::move(verdict.reason);
  step.segment = point.segment;
  step.fraction = point.fraction;
  step.progress = route_.ProgressAt(point.segment, point.fraction);
  if (trust_.ever_sure() && place_.metric()) step.along_m = where.along;
  step.magnification = place_.Magnification(place_.look().width_px).value_or(1.0);
  step.features = steering.turn.features;
  step.turn_rad = steering.turn.turn_rad;
  step.decision.turn_rad = step.decision.vision_turn_rad = step.turn_rad;
  step.decision.agreeing = where.agreed;
  step.decision.fraction = point.fraction;
  if (step.state == ReplayState::kFollowing) step.command = steering.command;
  return step;
}

void ViewFollower::EndAt(ReplayStep& step) const {
  step.command = {};
  step.segment = route_.segments().back().index;
  step.fraction = 1.0;
  step.progress = route_.ProgressAt(step.segment, step.fraction);
  step.state = route_.complete() ? ReplayState::kArrived : ReplayState::kWaiting;
  step.reason = route_.complete() ? "arrived at the end of the route"
                                  : fmt::format("waiting for segment {}: not received yet",
                                                route_.segments().size());
}

ReplayStep ViewFollower::Step(double dt_s) {
  const bool ends = SeesTheEnd() && (HasCome() || !route_.complete());
  ReplayStep step = Go(dt_s, Doubt());
  if (ends) EndAt(step);
  return step;
}

}  // namespace trailcast::agent
