#include "services/lab/trial/recording/src/grey_response.h"

#include <cmath>
#include <cstdint>

namespace trailcast::trial {

void Respond(double gamma, cv::Mat& picture) {
  cv::Mat table(1, 256, CV_8U);
  for (int grey = 0; grey < 256; ++grey) {
    table.at<std::uint8_t>(grey) =
        cv::saturate_cast<std::uint8_t>(255.0 * std::pow(grey / 255.0, gamma));
  }
  cv::LUT(picture, table, picture);
}

}  // namespace trailcast::trial
