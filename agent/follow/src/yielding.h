#pragma once

#include <optional>
#include <vector>

#include "agent/follow/keep_distance.h"
#include "agent/follow/src/stand.h"
#include "agent/session/replay_session.h"
#include "services/base/time.h"

namespace trailcast::agent {

// What becomes of a follower's steps with others ahead of it on its route: slower, or kYielding
// with the command to stand and the reason why. One that nobody is ahead of does exactly what it
// would do alone. Belongs to the control loop; no clock of its own.
class Yielding {
 public:
  using Time = KeepDistance::Time;

  Yielding(AgentId self, const KeepDistanceOptions& options)
      : enabled_(options.distance_m > 0.0), keep_distance_(std::move(self), options) {}

  // Who is on the route from now on.
  void Hear(std::vector<Neighbour> neighbours) { neighbours_ = std::move(neighbours); }

  // The step of a robot that has come to a stand behind another, as long as it has to; nothing:
  // look at the frame of this stamp, and Apply.
  [[nodiscard]] std::optional<ReplayStep> StandOn(SensorTime stamp, Time now);
  [[nodiscard]] ReplayStep Apply(ReplayStep step, SensorTime stamp, Time now);

 private:
  [[nodiscard]] Spacing SpacingFor(const ReplayStep& step, Time now);

  bool enabled_;
  KeepDistance keep_distance_;
  std::vector<Neighbour> neighbours_;
  Stand stand_;
};

}  // namespace trailcast::agent
