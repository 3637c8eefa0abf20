#pragma once

#include "services/base/result.h"
#include "services/sim/place.h"

namespace trailcast::sim {

// `paved`: 60 m over a parking lot, between rows of cars, with lamp posts, trees, hedges and the
// buildings round it.
[[nodiscard]] Result<Place> MakePavedWorld();

}  // namespace trailcast::sim
