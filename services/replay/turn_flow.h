#pragma once

#include <map>
#include <optional>
#include <vector>

#include "services/replay/focal_length.h"
#include "services/route/tracked_feature.h"

namespace trailcast::replay {

// This finds a robot's own focal length by how far features move in a turn on the spot, which needs
// no place, no depth and no route. Pixels are its own, from its image centre.
class TurnFlow {
 public:
  explicit TurnFlow(int width_px) : width_px_(width_px) {}

  // Takes the present places of features, and how far odometry says that the robot has turned to
  // the left since the last look. A feature keeps its id for as long as it is followed.
  void Look(const std::vector<route::TrackedFeature>& seen, double turned_rad);

  // Returns nothing before enough of them have moved enough.
  [[nodiscard]] std::optional<FocalLength> focal() const;

 private:
  struct Moved {
    route::TrackedFeature from;
    double from_rad = 0.0;  // to the left of the first heading
    route::TrackedFeature to;
    double turned_rad = 0.0;  // between the two, the largest so far
  };

  double width_px_;
  double heading_rad_ = 0.0;
  std::map<int, Moved> moved_;  // by id
};

}  // namespace trailcast::replay
