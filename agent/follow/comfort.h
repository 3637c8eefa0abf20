#pragma once

#include <vector>

#include "agent/session/replay_step.h"
#include "services/route/route.h"

namespace trailcast::agent {

// How much of the taught speed is comfortable there: what shakes up and down grows with the speed.
[[nodiscard]] double ComfortableShare(const route::Terrain& terrain);

// What becomes of a follower's steps on rough ground: slower than it was taught, from before it
// begins. The path stays the same. Where it is not known how far along the robot is, on routes that
// were taught without odometry, only as soon as it is on the rough segment or the one before.
class Comfort {
 public:
  explicit Comfort(bool wanted) : wanted_(wanted) {}

  // In the route's order.
  void Add(const route::Segment& segment);
  [[nodiscard]] ReplayStep Apply(ReplayStep step) const;

 private:
  struct Stretch {
    double begin_m = 0.0;
    double length_m = 0.0;
    double speed_mps = 0.0;  // at most; of a segment without odometry 0
    double share = 1.0;      // of the taught speed
  };
  [[nodiscard]] double MostMps(double along_m, double speed_mps, std::size_t segment) const;

  bool wanted_;
  std::vector<Stretch> stretches_;
};

}  // namespace trailcast::agent
