#pragma once

#include "services/base/result.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// `field`: 30 m over short grass in the open. Trees and buildings are all more than 40 m away.
[[nodiscard]] Result<Place> MakeFieldWorld();

}  // namespace trailcast::sim
