#include "services/vision/src/lens_surround.h"

#include <opencv2/imgproc.hpp>

#include "services/vision/src/frame.h"

namespace trailcast::vision {

void LensSurround::Add(const cv::Mat& frame) {
  cv::blur(frame, smoothed_, cv::Size(5, 5));
  if (brightest_.empty()) {
    smoothed_.copyTo(brightest_);
  } else {
    cv::max(brightest_, smoothed_, brightest_);
  }
}

bool LensSurround::any() const { return DarkSurround(brightest_).has_value(); }

cv::Mat LensSurround::FieldOfView() const { return vision::FieldOfView(brightest_); }

}  // namespace trailcast::vision
