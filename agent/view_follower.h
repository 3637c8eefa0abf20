#pragma once

#include <string_view>

#include "agent/place_keeper.h"
#include "agent/place_trust.h"
#include "agent/replay_method.h"
#include "agent/replay_step.h"
#include "services/motion/motion.h"
#include "services/replay/view_turn.h"

namespace trailcast::agent {

// Follows by the route's key views, for robots or routes without odometry: the belief says where
// the robot is and whether it may go on, the key views on either side where to turn (view_turn.h).
class ViewFollower {
 public:
  explicit ViewFollower(const ReplayMethodOptions& options) : options_(options) {}

  // By the look that `place` has just taken. `speed_mps`: as taught, where that is known. `doubt`:
  // what speaks against driving on although the place is held; empty: nothing.
  [[nodiscard]] ReplayStep Step(const PlaceKeeper& place, double speed_mps,
                                std::string_view doubt = "");

  // Where to turn and the command that does it, whether or not the place is to be trusted.
  struct Steering {
    replay::ViewTurn turn;
    motion::VelocityCommand command;
  };
  [[nodiscard]] Steering Steer(const PlaceKeeper& place, double speed_mps) const;

  // Whether what is seen is the end of what is known of the route, and whether the robot has come
  // there: what looks like the end from where it was put may be the beginning, of a lap, say.
  [[nodiscard]] static bool SeesTheEnd(const PlaceKeeper& place);
  [[nodiscard]] static bool HasCome(const PlaceKeeper& place);

 private:
  ReplayMethodOptions options_;
  PlaceTrust trust_;
};

}  // namespace trailcast::agent
