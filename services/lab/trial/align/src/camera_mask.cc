#include "services/lab/trial/align/src/camera_mask.h"

#include <opencv2/imgproc.hpp>

#include "services/lab/trial/recording/mat_view.h"

namespace trailcast::trial {
namespace {

constexpr int kFewestFrames = 12;   // with fewer, much stays the same by chance
constexpr int kStill = 12;          // grey levels; a smaller change is noise
constexpr double kMargin = 0.02;    // of the width, around what is still
constexpr double kLeastSeen = 0.2;  // of the picture; otherwise the robot stood, or it was dark

}  // namespace

void CameraMask::Add(const image::GrayImage& frame) {
  if (frames_ == 0) {
    darkest_ = brightest_ = frame;
  } else {
    cv::Mat darkest = View(darkest_);
    cv::Mat brightest = View(brightest_);
    cv::min(darkest, View(frame), darkest);
    cv::max(brightest, View(frame), brightest);
  }
  ++frames_;
}

image::GrayImage CameraMask::Find() const {
  if (frames_ < kFewestFrames) return {};
  image::GrayImage mask = Blank(darkest_.width, darkest_.height);
  cv::Mat seen = View(mask);
  cv::subtract(View(brightest_), View(darkest_), seen);
  cv::threshold(seen, seen, kStill, 255, cv::THRESH_BINARY);
  // Single pixels that happened to stay the same do not belong to the robot.
  const int margin = std::max(1, static_cast<int>(kMargin * mask.width));
  const cv::Mat around =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * margin + 1, 2 * margin + 1});
  cv::morphologyEx(seen, seen, cv::MORPH_CLOSE, around);
  cv::erode(seen, seen, around, {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  const double share = cv::countNonZero(seen) / static_cast<double>(seen.total());
  if (share < kLeastSeen) return {};
  return mask;
}

}  // namespace trailcast::trial
