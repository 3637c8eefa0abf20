#pragma once

#include <optional>
#include <vector>

#include "agent/follow/keep_distance.h"
#include "agent/follow/src/stand.h"
#include "agent/session/replay_session.h"
#include "services/base/time.h"

namespace trailcast::agent {

// Changes a follower's steps for others ahead of it on its route: it drives more slowly, or is
// kYielding with a command to stop and the reason. Without anybody ahead, the steps stay the same.
// It belongs to the control loop and has no clock of its own.
class Yielding {
 public:
  using Time = KeepDistance::Time;

  Yielding(AgentId self, const KeepDistanceOptions& options)
      : enabled_(options.distance_m > 0.0), keep_distance_(std::move(self), options) {}

  // Takes the robots that are on the route from now on.
  void Hear(std::vector<Neighbour> neighbours) { neighbours_ = std::move(neighbours); }

  // Returns the step of a robot that stands behind another, as long as it has to, or nothing if the
  // frame of this stamp must be looked at and passed to Apply.
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
