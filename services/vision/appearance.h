#pragma once

// For vision's own sources: a feature's appearance, cut out of a frame.

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "services/route/tracked_feature.h"

namespace trailcast::vision {

// The pattern around `centre` (OpenCV pixel coordinates) as the route stores it; nothing within
// half a patch of the edge.
[[nodiscard]] std::optional<route::Patch> CutPatch(const cv::Mat& frame, cv::Point2f centre);

// A key point for an upright ORB descriptor at the frame's own scale.
[[nodiscard]] cv::KeyPoint UprightKeyPoint(cv::Point2f at);

// Upright ORB descriptors, one row of 32 bytes for each key point; OpenCV drops key points too near
// the edge and reorders the rest, class_id tells which is which.
[[nodiscard]] cv::Mat DescribeUpright(const cv::Mat& frame, std::vector<cv::KeyPoint>& key_points);

}  // namespace trailcast::vision
