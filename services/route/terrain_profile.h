#pragma once

#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/route/terrain.h"

namespace trailcast::route {

// A stretch of a route over which the ground is much the same. In metres from the route's
// beginning, or, where it was taught without odometry, in seconds of teaching in motion.
struct TerrainStretch {
  double begin = 0.0;
  double end = 0.0;
  SegmentIndex first;
  Terrain terrain;  // the roughest of it, its mean slope
};

// What a route's segments say of the ground, from the first segment on.
class TerrainProfile {
 public:
  void Add(const Segment& segment);
  // In the route's order, without a gap: as rough all along, and as steep within a degree and a
  // half.
  [[nodiscard]] const std::vector<TerrainStretch>& stretches() const { return stretches_; }

 private:
  std::vector<TerrainStretch> stretches_;
};

// For people: "rough (1.20 m/s2), 4.1 degrees uphill", "uneven (shakes by 0.8 % of the picture)",
// "not known".
[[nodiscard]] std::string TerrainText(const Terrain& terrain);
// Of a roughness alone, likewise; "not known".
[[nodiscard]] std::string RoughnessText(const Terrain& terrain);
// "4.1 degrees uphill".
[[nodiscard]] std::string SlopeText(double slope_rad);

}  // namespace trailcast::route
