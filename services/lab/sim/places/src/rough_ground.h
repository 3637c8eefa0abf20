#pragma once

#include "services/base/result.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// `rough`: 40 m over uneven grass and earth with stones and tussocks, past trees, bushes, a fence
// and a shed. Robots roll and pitch by up to 5 degrees.
[[nodiscard]] Result<Place> MakeRoughWorld();

}  // namespace trailcast::sim
