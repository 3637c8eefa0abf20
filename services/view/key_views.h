#pragma once

#include <vector>

#include "services/route/route.h"

namespace trailcast::view {

// A segment's key views; of one that was taught before there were any, its own features where they
// were seen at its beginning, in its middle and at its end.
[[nodiscard]] std::vector<route::KeyView> KeyViewsOf(const route::Segment& segment);

// The same without those that followers added.
[[nodiscard]] std::vector<route::KeyView> ScoutViewsOf(const route::Segment& segment);

}  // namespace trailcast::view
