#include "agent/view_follower.h"

#include <utility>
#include <vector>

namespace trailcast::agent {
namespace {

constexpr double kLookAhead_s = 0.2;
constexpr double kLookAhead_m = 0.3;
constexpr double kArrived_s = 0.15;
constexpr double kArrived_m = 0.15;
constexpr double kCome_s = 1.0;
constexpr double kCome_m = 0.5;
constexpr double kTurnTime_s = 0.3;  // over which a turn is carried out

// What was recognised, in the scout's pixels at the scout's magnification.
std::vector<replay::SeenKeyView> Seen(const PlaceKeeper& place, const Look& look) {
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

bool ViewFollower::SeesTheEnd(const PlaceKeeper& place) {
  const double tolerance = place.metric() ? kArrived_m : kArrived_s;
  return place.where().held && place.where().along >= place.belief().length() - tolerance;
}

bool ViewFollower::HasCome(const PlaceKeeper& place) {
  return place.where().come >=
         std::min(place.metric() ? kCome_m : kCome_s, 0.5 * place.belief().length());
}

ViewFollower::Steering ViewFollower::Steer(const PlaceKeeper& place, double speed_mps) const {
  const double ahead = place.metric() ? kLookAhead_m : kLookAhead_s;
  const replay::ViewTurn turn = replay::TurnTowards(
      place.where().along + ahead, Seen(place, place.look()), place.recogniser().scout_width_px());
  return {turn, motion::Limit({speed_mps, -turn.turn_rad / kTurnTime_s}, options_.limits)};
}

ReplayStep ViewFollower::Step(const PlaceKeeper& place, double speed_mps, std::string_view doubt) {
  const belief::RouteBelief::Place& where = place.where();
  Verdict verdict = trust_.Judge(where, doubt);
  const RoutePoint point = place.point();
  const Steering steering = Steer(place, speed_mps);
  ReplayStep step;
  step.state = StateOf(verdict.trust);
  step.trust = verdict.trust;
  step.reason = std::move(verdict.reason);
  step.segment = point.segment;
  step.fraction = point.fraction;
  if (trust_.ever_sure() && place.metric()) step.along_m = where.along;
  step.magnification = place.Magnification(place.look().width_px).value_or(1.0);
  step.features = steering.turn.features;
  step.turn_rad = steering.turn.turn_rad;
  step.decision.turn_rad = step.decision.vision_turn_rad = step.turn_rad;
  step.decision.agreeing = where.agreed;
  step.decision.fraction = point.fraction;
  if (step.state == ReplayState::kFollowing) step.command = steering.command;
  return step;
}

}  // namespace trailcast::agent
