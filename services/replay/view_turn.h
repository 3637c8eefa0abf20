#pragma once

#include <span>
#include <vector>

#include "services/replay/funnel_lane.h"

namespace trailcast::replay {

// This is a key view of the route that is recognised in the present picture: its features as pairs
// for the funnel lane, with the key view as the milestone, and the present picture at its
// magnification.
struct SeenKeyView {
  double along = 0.0;  // the scout's place there, in the route's units
  std::vector<FunnelPair> pairs;
};

struct ViewTurnOptions {
  // This is gamma, in radians per pixel of the scout's picture, if it were 320 px wide: the angle
  // of one pixel of a usual webcam.
  double gain_rad_per_px_at_320 = 0.0035;
  double largest_rad = 0.6;
  int fewest_pairs = 5;
};

struct ViewTurn {
  double turn_rad = 0.0;  // desired heading change, positive to the right
  int features = 0;       // that were used; 0 if no view tells
};

// Returns where to turn for the place `aim` of the route, by the key views recognised on either
// side of it.
[[nodiscard]] ViewTurn TurnTowards(double aim, std::span<const SeenKeyView> seen,
                                   int scout_width_px, const ViewTurnOptions& options = {});

}  // namespace trailcast::replay
