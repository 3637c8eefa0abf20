#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// Returns the same metres from the other end: knots, key views, heading and slope as a robot meets
// them that drives the segment in the other gear, with its camera looking the same way. The patches
// of its features alone stay unchanged; they were taken where the returned segment ends.
[[nodiscard]] Segment FromOtherEnd(const Segment& segment);

// This is a share of the taught speed: a robot that backs sees where it comes from, not where it
// goes.
inline constexpr double kBackwardsPace = 0.5;

// Returns a route as it would have been taught by backing along it from its end to its beginning,
// at that share of its speed. Patches are enlarged to the size of what they show where each segment
// then begins. Fails with kInvalidArgument if a segment was taught driving backwards or without
// odometry.
[[nodiscard]] Result<std::vector<Segment>> DrivenBackwards(const std::vector<Segment>& route);

}  // namespace trailcast::route
