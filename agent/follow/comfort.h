#pragma once

#include <vector>

#include "agent/session/replay_step.h"
#include "services/route/route.h"

namespace trailcast::agent {

// Returns the share of the taught speed that is comfortable there: vertical shaking grows with the
// speed.
[[nodiscard]] double ComfortableShare(const route::Terrain& terrain);

// Slows a follower's steps on rough ground, and before it, below the taught speed. The path stays
// the same. On routes that were taught without odometry, the place along the route is not known,
// and it slows only once the robot is on the rough segment or the one before.
class Comfort {
 public:
  explicit Comfort(bool wanted) : wanted_(wanted) {}

  // Segments are added in the route's order.
  void Add(const route::Segment& segment);
  [[nodiscard]] ReplayStep Apply(ReplayStep step) const;

 private:
  struct Section {
    double begin_m = 0.0;
    double length_m = 0.0;
    double speed_mps = 0.0;  // the most; 0 for a segment without odometry
    double share = 1.0;      // of the taught speed
  };
  [[nodiscard]] double MostMps(double along_m, double speed_mps, std::size_t segment) const;

  bool wanted_;
  std::vector<Section> sections_;
};

}  // namespace trailcast::agent
