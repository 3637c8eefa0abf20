#pragma once

#include "services/base/result.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// These are offices lit by lamps, for narrow and for plain surroundings.

// `turns`: 25 m round five corners of 90 to 125 degrees, past some plain walls, into a room.
[[nodiscard]] Result<Place> MakeTurnsWorld();
// `desks`: 10 m between chairs and desks, 0.33 m or more from the sides of a robot on its way.
[[nodiscard]] Result<Place> MakeDesksWorld();
// `corridor`: 30 m of corridor; after 12 m come 4 m with nothing on walls, floor and ceiling, and
// then a bend, so that little is seen beyond them.
[[nodiscard]] Result<Place> MakeCorridorWorld();

}  // namespace trailcast::sim
