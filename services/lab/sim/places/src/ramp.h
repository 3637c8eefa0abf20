#pragma once

#include "services/base/result.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// `ramp`: 40 m of paved way, up a ramp of 4 degrees to a metre's height and down again, between
// walls and railings beside a building. The ramp leans sideways a little, too.
[[nodiscard]] Result<Place> MakeRampWorld();

}  // namespace trailcast::sim
