#pragma once

#include "services/base/result.h"
#include "services/lab/sim/places/place.h"
#include "services/lab/sim/places/place_change.h"

namespace trailcast::sim {

// `indoor`: two furnished laboratory rooms of 12 m x 9 m in all, joined by a wide doorway, with a
// path of 15 m that turns from one into the other. It is always the same, and takes about a second
// to make.
[[nodiscard]] Result<Place> MakeIndoorWorld();
// Makes the same place after a change.
[[nodiscard]] Result<Place> MakeIndoorWorld(const PlaceChange& change);
// `dead-end`: the same place, with a path of 18 m from the doorway to the north room's far end,
// where it turns on the spot, back by the same way and on into the south room.
[[nodiscard]] Result<Place> MakeDeadEndWorld();

}  // namespace trailcast::sim
