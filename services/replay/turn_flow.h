#pragma once

#include <map>
#include <optional>
#include <vector>

#include "services/replay/focal_length.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

// A robot's own focal length, by how far a turn on the spot moves what it sees: that needs no
// place, no depth and no route. Pixels are its own, from its image centre.
class TurnFlow {
 public:
  explicit TurnFlow(int width_px) : width_px_(width_px) {}

  // Where features are now, and how far odometry says that it has turned to the left since the last
  // look. A feature keeps its id for as long as it is followed.
  void Look(const std::vector<route::TrackedFeature>& seen, double turned_rad);

  // Nothing before enough of them have moved by enough.
  [[nodiscard]] std::optional<FocalLength> focal() const;

 private:
  struct Moved {
    route::TrackedFeature from;
    double from_rad = 0.0;  // to the left of where the robot faced at first
    route::TrackedFeature to;
    double turned_rad = 0.0;  // between the two, the most so far
  };

  double width_px_;
  double heading_rad_ = 0.0;
  std::map<int, Moved> moved_;  // by id
};

}  // namespace trailcast::replay
