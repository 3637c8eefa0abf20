#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace trailcast::vision {

// The black surround that some lenses leave (a fisheye's circle on a larger chip), by what has
// stayed black in all frames so far: what is only dark is lit once the robot has come elsewhere.
// All frames must have the size of the first.
class LensSurround {
 public:
  void Add(const cv::Mat& frame);

  // As DarkSurround and FieldOfView have it of one frame (frame.h). At least one frame was added.
  [[nodiscard]] bool any() const;
  [[nodiscard]] cv::Mat FieldOfView() const;

 private:
  cv::Mat brightest_;  // smoothed
  cv::Mat smoothed_;   // kept for its memory
};

}  // namespace trailcast::vision
