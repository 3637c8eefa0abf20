#include "services/lab/trial/recording/src/other_camera.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "services/lab/trial/recording/mat_view.h"
#include "services/lab/trial/recording/src/grey_response.h"

namespace trailcast::trial {
namespace {

struct Maps {
  cv::Mat x;
  cv::Mat y;
};

// Returns, for each pixel of the other camera, the place in the first one's picture at which it
// looks.
Maps LookUp(const OtherCamera& camera, cv::Size from) {
  Maps maps{cv::Mat(camera.height, camera.width, CV_32F),
            cv::Mat(camera.height, camera.width, CV_32F)};
  const double half = 0.5 * camera.width;
  const double scale = camera.magnification * camera.width / from.width;
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const double u = column - 0.5 * (camera.width - 1);
      const double v = row - 0.5 * (camera.height - 1);
      // This inverts the distortion; a few steps are precise enough.
      const double bent = std::hypot(u, v) / half;
      double straight = bent;
      for (int i = 0; i < 8; ++i) straight = bent / (1.0 - camera.barrel * straight * straight);
      const double stretch = bent > 0.0 ? straight / bent : 1.0;
      maps.x.at<float>(row, column) =
          static_cast<float>(0.5 * (from.width - 1) + stretch * u / scale);
      maps.y.at<float>(row, column) =
          static_cast<float>(0.5 * (from.height - 1) + stretch * v / scale);
    }
  }
  return maps;
}

}  // namespace

image::GrayImage Through(const OtherCamera& camera, const image::GrayImage& frame) {
  const Maps maps = LookUp(camera, {frame.width, frame.height});
  image::GrayImage seen = Blank(camera.width, camera.height);
  cv::Mat target = View(seen);
  cv::remap(View(frame), target, maps.x, maps.y, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  Respond(camera.gamma, target);
  return seen;
}

}  // namespace trailcast::trial
