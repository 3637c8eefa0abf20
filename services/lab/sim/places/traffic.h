#pragma once

#include <cstdint>

#include "services/base/result.h"
#include "services/lab/sim/core/actor.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// These functions draw from the seed who moves at a place while the robot of that role drives along
// its path. Times follow from the path and the place's speed, so that they meet where they should.

// A pedestrian comes along the right-hand pavement, crosses over in front of the follower and
// passes it; then a van drives by. While the scout teaches, there may be a stroller far off.
[[nodiscard]] Result<Actors> RoadTraffic(const Place& place, Role role, std::uint64_t seed);

// People walk on the pavement behind the parked cars, others when teaching than when following.
[[nodiscard]] Result<Actors> PavementTraffic(const Place& place, Role role, std::uint64_t seed);

// Returns the place's own traffic, or nobody.
[[nodiscard]] Result<Actors> TrafficFor(const Place& place, Role role, std::uint64_t seed);

// Returns a person in a long coat who steps in front of the robot, `ahead_m` ahead of its middle,
// and stands in its way, somewhere on the middle third of the path.
[[nodiscard]] Result<Actor> SomebodyInTheWay(const Place& place, std::uint64_t seed,
                                             double ahead_m);

// Returns a cart that was left on a straight part of the path, on the side with less room. One side
// of it is a little beyond the path's middle.
[[nodiscard]] Result<Actor> CartOnThePath(const Place& place, std::uint64_t seed);

}  // namespace trailcast::sim
