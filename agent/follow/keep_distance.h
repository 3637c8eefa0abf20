#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>

#include "agent/link/neighbours.h"

namespace trailcast::agent {

struct KeepDistanceOptions {
  double distance_m = 1.5;  // along the path, to the robot ahead; 0 keeps none
  // A robot slows down so that it would stop at the distance, with this deceleration and this
  // delay.
  double deceleration_mps2 = 0.4;
  double reaction_s = 0.2;
  double standing_mps = 0.03;  // a slower robot stands
  double go_on_m = 0.3;        // a standing robot goes on when there is so much more room
};

// The speed that a robot may drive with others on its route.
struct Spacing {
  double speed_factor = 1.0;           // of its speed without others, 0..1
  std::optional<Neighbour> waits_for;  // the robot behind which it stands
  double ahead_m = 0.0;                // how far that one is ahead, 0 beside it
};

// Returns "waits for robot2, 1.4 m ahead", for people.
[[nodiscard]] std::string WaitText(const Spacing& spacing,
                                   std::chrono::steady_clock::time_point now);

// Keeps a follower's distance along the path to robots ahead of it. It counts from the places that
// they last reported, so a bad radio makes the distance longer and never shorter. Among robots at
// the same place along the path, as where all stand at its start, the first by name goes first. A
// closed route's end is not ahead of its beginning. It has no thread.
class KeepDistance {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit KeepDistance(AgentId self, const KeepDistanceOptions& options = {})
      : self_(std::move(self)), options_(options) {}

  // `along_m` is the robot's place on the route, which all `neighbours` share; `speed_mps` is its
  // speed without others, above 0.
  [[nodiscard]] Spacing Keep(double along_m, double speed_mps,
                             std::span<const Neighbour> neighbours, Time now);

 private:
  [[nodiscard]] bool IsAhead(const Neighbour& other, double along_m, Time now) const;
  [[nodiscard]] double SpeedWithin(double room_m) const;

  AgentId self_;
  KeepDistanceOptions options_;
  bool standing_ = false;
};

}  // namespace trailcast::agent
