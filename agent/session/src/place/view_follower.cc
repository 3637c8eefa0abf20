#include "agent/session/src/place/view_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
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

bool SeesTheEnd(const Localiser& place) {
  const double tolerance = place.metric() ? kArrived_m : kArrived;
  return place.where().held && place.where().along >= place.belief().length() - tolerance;
}

bool HasCome(const Localiser& place) {
  return place.where().come >=
         std::min(place.metric() ? kCome_m : kCome, 0.5 * place.belief().length());
}

// Returns what comes, at the place or shortly after, that key views cannot steer through. In a turn
// on the spot all views are of one place, whatever their direction, and none tells where to go. On
// a part that is driven backwards they ask for the wrong turn.
std::string_view DoesNotDrive(const KnownRoute& route, const Localiser& place) {
  if (!place.where().held) return "";
  const RoutePoint point = place.point();
  if (route.segment(point.segment).reverse) return kReverse;
  const RoutePoint next{SegmentIndex(point.segment.value() + 1), 0.0};
  if (!route.has(next.segment.value()) || place.AlongOf(next) - place.where().along >= kTurn_m) {
    return "";
  }
  if (route.segment(next.segment).reverse) return kReverse;
  return std::abs(route.turn_after_rad(point.segment)) > kTurnsAway_rad ? kTurn : "";
}

std::string_view DoubtOf(const KnownRoute& route, const Localiser& place) {
  if (const std::string_view what = DoesNotDrive(route, place); !what.empty()) return what;
  return route.complete() && SeesTheEnd(place) && !HasCome(place) ? kOnlyTheEnd : "";
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

ReplayStep ViewFollower::Step(double dt_s) {
  const belief::RouteBelief::Place& where = place_.where();
  Verdict verdict = trust_.Judge(where, dt_s, DoubtOf(route_, place_));
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
  if (!SeesTheEnd(place_) || (route_.complete() && !HasCome(place_))) return step;
  step.command = {};
  step.segment = route_.segments().back().index;
  step.fraction = 1.0;
  step.progress = route_.ProgressAt(step.segment, step.fraction);
  step.state = route_.complete() ? ReplayState::kArrived : ReplayState::kWaiting;
  step.reason = route_.complete() ? "arrived at the end of the route"
                                  : fmt::format("waiting for segment {}: not received yet",
                                                route_.segments().size());
  return step;
}

}  // namespace trailcast::agent
