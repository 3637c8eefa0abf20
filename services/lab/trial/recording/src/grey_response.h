#pragma once

#include <opencv2/core.hpp>

namespace trailcast::trial {

// Changes grey levels to 255 (grey / 255)^gamma, in place.
void Respond(double gamma, cv::Mat& picture);

}  // namespace trailcast::trial
