#pragma once

#include "services/base/result.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// `road`: 80 m along a narrow, slightly curved road, between fences, hedges, parked cars and house
// fronts with rows of windows one like the other.
[[nodiscard]] Result<Place> MakeRoadWorld();

}  // namespace trailcast::sim
