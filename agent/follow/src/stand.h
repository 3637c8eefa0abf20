#pragma once

#include <optional>

#include "agent/session/replay_session.h"
#include "services/base/time.h"

namespace trailcast::agent {

// The steps of a robot that has to stand although it is not at its route's end. Once it has come to
// a stand it need not look at its pictures: there is nothing to learn from them, and whoever passes
// before it would only confuse it. Belongs to the control loop; no clock of its own.
class Stand {
 public:
  // What it wished for when it came to a stand; nothing: look at the frame of this stamp first.
  [[nodiscard]] const ReplayStep* WithoutLooking(SensorTime stamp) const;
  // It stands on `step`, which a look at this frame gave.
  void Begin(const ReplayStep& step, SensorTime stamp);
  // It may drive.
  void End() { since_.reset(); }

 private:
  std::optional<SensorTime> since_;
  ReplayStep wish_;
};

// The same step of a robot that stands, and why.
[[nodiscard]] ReplayStep StandingStep(ReplayStep step, ReplayState state, std::string reason);

}  // namespace trailcast::agent
