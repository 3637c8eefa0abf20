#pragma once

#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/route/terrain.h"

namespace trailcast::route {

// This is a section of a route with much the same ground. Its ends are in metres from the route's
// beginning or, if the route was taught without odometry, in seconds of teaching in motion.
struct TerrainSection {
  double begin = 0.0;
  double end = 0.0;
  SegmentIndex first;
  Terrain terrain;  // its roughest ground and its mean slope
};

// This collects what a route's segments tell of the ground, from the first segment on.
class TerrainProfile {
 public:
  void Add(const Segment& segment);
  // Returns the sections in the route's order, without gaps. In each, the ground is of one
  // roughness, and its slopes agree within a degree and a half.
  [[nodiscard]] const std::vector<TerrainSection>& sections() const { return sections_; }

 private:
  std::vector<TerrainSection> sections_;
};

// Returns, for people, "rough (1.20 m/s2), 4.1 degrees uphill", "uneven (shakes by 0.8 % of the
// picture)" or "not known".
[[nodiscard]] std::string TerrainText(const Terrain& terrain);
// Returns the part about roughness alone, or "not known".
[[nodiscard]] std::string RoughnessText(const Terrain& terrain);
// Returns "4.1 degrees uphill".
[[nodiscard]] std::string SlopeText(double slope_rad);

}  // namespace trailcast::route
