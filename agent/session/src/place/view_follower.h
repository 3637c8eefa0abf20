#pragma once

#include <string_view>

#include "agent/session/replay_method.h"
#include "agent/session/replay_step.h"
#include "agent/session/src/place/known_route.h"
#include "agent/session/src/place/place_keeper.h"
#include "agent/session/src/place/place_trust.h"
#include "services/motion/motion.h"
#include "services/replay/view_turn.h"

namespace trailcast::agent {

// Where to turn by the key views on either side of the place (view_turn.h), and the command that
// does it, whether or not that place is to be trusted.
struct ViewSteering {
  replay::ViewTurn turn;
  motion::VelocityCommand command;
};
[[nodiscard]] ViewSteering SteerByViews(const PlaceKeeper& place, double speed_mps,
                                        const motion::VelocityLimits& limits);

// Follows by the route's key views, for robots or routes without odometry: the belief says where
// the robot is and whether it may go on, the key views on either side where to turn.
class ViewFollower {
 public:
  // `route` and `place` outlive it.
  ViewFollower(const ReplayMethodOptions& options, const KnownRoute& route,
               const PlaceKeeper& place)
      : options_(options), route_(route), place_(place) {}

  // By the look that the place has just been taken by.
  [[nodiscard]] ReplayStep Step(double dt_s);

 private:
  // Whether what is seen is the end of what is known of the route, and whether the robot has come
  // there: what looks like the end from where it was put may be the beginning, of a lap, say.
  [[nodiscard]] bool SeesTheEnd() const;
  [[nodiscard]] bool HasCome() const;
  [[nodiscard]] std::string_view DoesNotDrive() const;
  // What speaks against driving on although the place is held; empty: nothing.
  [[nodiscard]] std::string_view Doubt() const;
  [[nodiscard]] ReplayStep Go(double dt_s, std::string_view doubt);
  void EndAt(ReplayStep& step) const;

  ReplayMethodOptions options_;
  const KnownRoute& route_;
  const PlaceKeeper& place_;
  PlaceTrust trust_;
};

}  // namespace trailcast::agent
