#pragma once

#include "services/base/result.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// `paved`: 60 m over a parking lot, between rows of cars, with lamp posts, trees, hedges and the
// buildings round it.
[[nodiscard]] Result<Place> MakePavedWorld();

// `parking-place`: the same lot, with a path of 22 m backwards out of a bay and on along the lane.
[[nodiscard]] Result<Place> MakeParkingPlaceWorld();

// `loop`: 380 m round a larger one, closed: the last way-point is the first. Most of it passes
// rows of cars and trees; along the north there is little near by but asphalt.
[[nodiscard]] Result<Place> MakeLoopWorld();

}  // namespace trailcast::sim
