#pragma once

#include <string>

#include "agent/session/confidence.h"
#include "agent/session/replay_state.h"
#include "agent/session/replay_step.h"

namespace trailcast::agent {

// This is a run's status, from one frame to the next.
struct Standing {
  ReplayState state = ReplayState::kWaiting;
  Trust trust = Trust::kSeeking;
  std::string reason;  // one line for people
};

[[nodiscard]] inline Standing StandingOf(const ReplayStep& step) {
  return {step.state, step.trust, step.reason};
}

}  // namespace trailcast::agent
