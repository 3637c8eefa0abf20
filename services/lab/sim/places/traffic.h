#pragma once

#include <cstdint>

#include "services/base/result.h"
#include "services/lab/sim/core/actor.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// Who moves at a place while the robot of that role drives along its path, drawn from the seed.
// Times follow from the path and the place's speed, so that they meet where they should.

// A pedestrian comes along the right-hand pavement, crosses over in front of the follower and
// passes it; then a van drives by. While the scout teaches, there may be a stroller far off.
[[nodiscard]] Result<Actors> RoadTraffic(const Place& place, Role role, std::uint64_t seed);

// People on the pavement behind the parked cars: others when teaching than when following.
[[nodiscard]] Result<Actors> PavementTraffic(const Place& place, Role role, std::uint64_t seed);

// The place's own, or nobody.
[[nodiscard]] Result<Actors> TrafficFor(const Place& place, Role role, std::uint64_t seed);

// Somebody in a long coat who steps in front of the robot, so far ahead of its middle, and stands
// in its way, somewhere on the middle third of the path.
[[nodiscard]] Result<Actor> SomebodyInTheWay(const Place& place, std::uint64_t seed,
                                             double ahead_m);

// A cart that was left on the path, where it goes straight, with one side of it a little beyond the
// path's middle: on that side of the path where there is less room.
[[nodiscard]] Result<Actor> CartOnThePath(const Place& place, std::uint64_t seed);

}  // namespace trailcast::sim
