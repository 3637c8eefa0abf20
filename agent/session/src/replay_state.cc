#include "agent/session/replay_state.h"

namespace trailcast::agent {

const char* ToString(ReplayState state) {
  switch (state) {
    case ReplayState::kWaiting:
      return "WAITING";
    case ReplayState::kYielding:
      return "YIELDING";
    case ReplayState::kHeld:
      return "HELD";
    case ReplayState::kFollowing:
      return "FOLLOWING";
    case ReplayState::kBlind:
      return "BLIND";
    case ReplayState::kArrived:
      return "ARRIVED";
    case ReplayState::kLost:
      return "LOST";
  }
  return "UNKNOWN";
}

bool Waits(ReplayState state) {
  return state == ReplayState::kWaiting || state == ReplayState::kYielding ||
         state == ReplayState::kHeld;
}

ReplayState StateOf(Trust trust) {
  switch (trust) {
    case Trust::kSure:
    case Trust::kUnsure:
    case Trust::kDistant:
      return ReplayState::kFollowing;
    case Trust::kBlind:
    case Trust::kCovered:
    case Trust::kSeeking:
    case Trust::kLooking:
      return ReplayState::kBlind;
    case Trust::kLost:
      break;
  }
  return ReplayState::kLost;
}

}  // namespace trailcast::agent
