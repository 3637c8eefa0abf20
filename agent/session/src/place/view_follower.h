#pragma once

#include "agent/session/replay_method.h"
#include "agent/session/replay_step.h"
#include "agent/session/src/place/known_route.h"
#include "agent/session/src/place/localiser.h"
#include "agent/session/src/place/place_trust.h"
#include "services/motion/motion.h"
#include "services/replay/view_turn.h"

namespace trailcast::agent {

// This is where to turn by the key views on either side of the place (view_turn.h), and the command
// that does it, whether or not that place can be trusted.
struct ViewSteering {
  replay::ViewTurn turn;
  motion::VelocityCommand command;
};
[[nodiscard]] ViewSteering SteerByViews(const Localiser& place, double speed_mps,
                                        const motion::VelocityLimits& limits);

// This follows by the route's key views, for robots or routes without odometry: the belief tells
// where the robot is and whether it may go on, and the key views on either side tell where to turn.
class ViewFollower {
 public:
  // `route` and `place` have to outlive it.
  ViewFollower(const ReplayMethodOptions& options, const KnownRoute& route, const Localiser& place)
      : options_(options), route_(route), place_(place) {}

  // Makes a step by the look that the place has just taken.
  [[nodiscard]] ReplayStep Step(double dt_s);

 private:
  ReplayMethodOptions options_;
  const KnownRoute& route_;
  const Localiser& place_;
  PlaceTrust trust_;
};

}  // namespace trailcast::agent
