#pragma once

#include "agent/session/confidence.h"

namespace trailcast::agent {

enum class ReplayState {
  kWaiting,    // stands at the end of what is known of the route, until more comes
  kYielding,   // stands as near behind another follower as it may come, until that one goes on
  kHeld,       // stands until an operator resumes it
  kFollowing,  // by vision, and by odometry if there is any
  // It sees too few features. It goes on slowly by odometry alone for a short distance, or stands
  // if the route's start has not been found or something covers the view.
  kBlind,
  kArrived,  // past the last milestone of a complete route
  kLost,     // it cannot go on, `reason` says why, and the command is "stop"
};

[[nodiscard]] const char* ToString(ReplayState state);

// Tells that the robot stands on purpose, until others have done something.
[[nodiscard]] bool Waits(ReplayState state);

// Returns what a verdict means to those who watch the robot.
[[nodiscard]] ReplayState StateOf(Trust trust);

}  // namespace trailcast::agent
