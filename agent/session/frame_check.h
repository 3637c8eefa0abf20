#pragma once

#include <optional>

#include "agent/session/observation.h"
#include "services/base/result.h"

namespace trailcast::agent {

// This checks what a session relies on from one observation to the next.
class FrameCheck {
 public:
  // Returns kInvalidArgument for a frame that is empty or too small, for one of another size than
  // the first, or for odometry that appears or vanishes midway.
  [[nodiscard]] Result<void> Check(const Observation& observation);

 private:
  struct First {
    int width = 0;
    int height = 0;
    bool odometry = false;
  };
  std::optional<First> first_;
};

}  // namespace trailcast::agent
