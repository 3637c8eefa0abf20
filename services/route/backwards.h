#pragma once

#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

// The same metres from the other end: knots, key views, heading and slope as a robot meets them
// that drives the segment's way in the other gear, its camera looking the same way. Of its features
// only the patches stay as they are, which were taken where it ends then.
[[nodiscard]] Segment FromOtherEnd(const Segment& segment);

// Of the taught speed: a robot that backs sees where it comes from.
inline constexpr double kBackwardsPace = 0.5;

// A route as it would have been taught by backing along it, from its end to its beginning, at that
// share of its speed: patches as large as what they show is where each segment then begins.
// kInvalidArgument: a segment was taught driving backwards, or without odometry.
[[nodiscard]] Result<std::vector<Segment>> DrivenBackwards(const std::vector<Segment>& route);

}  // namespace trailcast::route
