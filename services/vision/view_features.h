#pragma once

#include "services/image/image.h"
#include "services/route/view.h"

namespace trailcast::vision {

// What a frame shows, as a catalog is asked for it: features found and described as teaching finds
// and describes a segment's, but more of them, at most route::kMaxViewFeatures, for a robot that
// stands beside the path sees others than the strongest. A donut is unrolled as for teaching.
// Empty where there is nothing to hold on to.
[[nodiscard]] route::View DescribeView(const image::GrayImage& frame);

}  // namespace trailcast::vision
