#pragma once

#include <optional>

#include "agent/session/replay_session.h"
#include "services/base/time.h"

namespace trailcast::agent {

// The steps of a robot that has to stand before it reaches its route's end. Once it stands, it does
// not look at its pictures: they teach it nothing, and a passer-by would only confuse it. It
// belongs to the control loop and has no clock of its own.
class Stand {
 public:
  // Returns the step with which it came to a stand, or nothing if the frame of this stamp must be
  // looked at first.
  [[nodiscard]] const ReplayStep* WithoutLooking(SensorTime stamp) const;
  // Notes that it stands with `step`, the result for this frame.
  void Begin(const ReplayStep& step, SensorTime stamp);
  // Lets it drive.
  void End() { since_.reset(); }

 private:
  std::optional<SensorTime> since_;
  ReplayStep wish_;
};

// Returns the same step for a standing robot, with the reason.
[[nodiscard]] ReplayStep StandingStep(ReplayStep step, ReplayState state, std::string reason);

}  // namespace trailcast::agent
