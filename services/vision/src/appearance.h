#pragma once

// For vision's own sources: a feature's appearance, cut out of a frame.

#include <opencv2/core.hpp>
#include <optional>

#include "services/route/tracked_feature.h"

namespace trailcast::vision {

// The pattern around `centre` (OpenCV pixel coordinates) as the route stores it; nothing within
// half a patch of the edge.
[[nodiscard]] std::optional<route::Patch> CutPatch(const cv::Mat& frame, cv::Point2f centre);

}  // namespace trailcast::vision
