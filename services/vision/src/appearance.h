#pragma once

// This header is for vision's own sources: it cuts a feature's appearance out of a frame.

#include <opencv2/core.hpp>
#include <optional>

#include "services/route/tracked_feature.h"

namespace trailcast::vision {

// Returns the pattern around `centre` (OpenCV's pixel coordinates) as the route stores it, or
// nothing within half a patch of the edge.
[[nodiscard]] std::optional<route::Patch> CutPatch(const cv::Mat& frame, cv::Point2f centre);

}  // namespace trailcast::vision
