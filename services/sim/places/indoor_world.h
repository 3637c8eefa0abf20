#pragma once

#include "services/base/result.h"
#include "services/sim/places/place.h"

namespace trailcast::sim {

// `indoor`: two furnished laboratory rooms of 12 m x 9 m in all, joined by a wide doorway, with a
// path of 15 m that turns from one into the other. Always the same; takes about a second to make.
[[nodiscard]] Result<Place> MakeIndoorWorld();

}  // namespace trailcast::sim
