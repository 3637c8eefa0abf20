#pragma once

#include <vector>

#include "services/route/route.h"

namespace trailcast::view {

// Returns a segment's key views. A segment from before there were any gets its own features
// instead, where they were seen at its beginning, in its middle and at its end.
[[nodiscard]] std::vector<route::KeyView> KeyViewsOf(const route::Segment& segment);

// Returns the same without those that followers added.
[[nodiscard]] std::vector<route::KeyView> ScoutViewsOf(const route::Segment& segment);

}  // namespace trailcast::view
