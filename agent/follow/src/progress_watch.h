#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "agent/session/replay_session.h"
#include "services/base/time.h"

namespace trailcast::agent {

// Notices that a robot gets no further.
class ProgressWatch {
 public:
  explicit ProgressWatch(std::chrono::seconds limit) : limit_(limit) {}

  // `held` means that the robot cannot go on for a reason that is reported and waited for
  // elsewhere.
  [[nodiscard]] bool Stuck(SensorTime stamp, const ReplayStep& step, bool held) {
    const double place = step.segment.value() + step.fraction;
    const bool further = place > furthest_ + 1e-3;
    if (further || held || Waits(step.state) || !since_) {
      furthest_ = std::max(furthest_, place);
      since_ = stamp;
    }
    return stamp - *since_ > limit_;
  }

 private:
  std::chrono::seconds limit_;
  double furthest_ = -1.0;
  std::optional<SensorTime> since_;
};

}  // namespace trailcast::agent
