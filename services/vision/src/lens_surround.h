#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace trailcast::vision {

// Finds the black surround that some lenses leave (a fisheye's circle on a larger chip) as the
// pixels that have stayed black in all frames so far. A dark object's pixels light up once the
// robot has moved. All frames must have the size of the first.
class LensSurround {
 public:
  void Add(const cv::Mat& frame);

  // Both need at least one frame; see DarkSurround and FieldOfView in frame.h.
  [[nodiscard]] bool any() const;
  [[nodiscard]] cv::Mat FieldOfView() const;

 private:
  cv::Mat brightest_;  // smoothed
  cv::Mat smoothed_;   // kept to reuse its memory
};

}  // namespace trailcast::vision
