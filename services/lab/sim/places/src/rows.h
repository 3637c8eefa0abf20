#pragma once

#include "services/base/result.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// This is from one aisle's middle to the next one's.
inline constexpr double kRowSpacing_m = 2.5;

// `rows`: forty rows of plants that look alike. The path goes 24 m down one aisle, leaves out the
// next one, and comes back along the one after that.
[[nodiscard]] Result<Place> MakeRowsWorld();

}  // namespace trailcast::sim
