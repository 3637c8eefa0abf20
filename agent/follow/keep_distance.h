#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>

#include "agent/link/neighbours.h"

namespace trailcast::agent {

struct KeepDistanceOptions {
  double distance_m = 1.5;  // along the path, to whoever is ahead; 0: none is kept
  // A robot slows down so that it stands where the distance would be passed: so gently, and so long
  // after it was told to.
  double deceleration_mps2 = 0.4;
  double reaction_s = 0.2;
  double standing_mps = 0.03;  // slower than this it stands
  double go_on_m = 0.3;        // standing, it goes on when there is so much more room
};

// How fast a robot may drive with others on its route.
struct Spacing {
  double speed_factor = 1.0;           // of the speed that it would drive at, 0..1
  std::optional<Neighbour> waits_for;  // it stands behind this one
  double ahead_m = 0.0;                // how far that one is ahead, 0 beside it
};

// For people: "waits for robot2, 1.4 m ahead".
[[nodiscard]] std::string WaitText(const Spacing& spacing,
                                   std::chrono::steady_clock::time_point now);

// Keeps a follower's distance along the path to those ahead of it. It counts from the place that
// they last told, so that a bad radio makes it longer and never shorter. Of robots that cannot be
// told apart along the path, as where all stand at its start, the first by name goes first.
// A closed route's end is not ahead of its beginning. No thread.
class KeepDistance {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit KeepDistance(AgentId self, const KeepDistanceOptions& options = {})
      : self_(std::move(self)), options_(options) {}

  // `along_m`: the own place on the route that all `neighbours` are on; `speed_mps`: what the robot
  // would drive at alone, above 0.
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
