#pragma once

#include "agent/session/confidence.h"

namespace trailcast::agent {

enum class ReplayState {
  kWaiting,    // at the end of what is known of the route: standing until more comes
  kYielding,   // behind another follower, as near as it may come: standing until that one goes on
  kHeld,       // an operator has it stand: until one tells it to go on
  kFollowing,  // by vision (and odometry, where there is any)
  // Too few features: by odometry alone for a short way, slowly; standing, where the route's start
  // has not been found and where something covers the view.
  kBlind,
  kArrived,  // past the last milestone of a complete route
  kLost,     // cannot go on: `reason` says why; the command is "stop"
};

[[nodiscard]] const char* ToString(ReplayState state);

// The robot stands on purpose, until others have done something.
[[nodiscard]] bool Waits(ReplayState state);

// What a verdict is to those who watch the robot.
[[nodiscard]] ReplayState StateOf(Trust trust);

}  // namespace trailcast::agent
