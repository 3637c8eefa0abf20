#include "services/vision/donut.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "services/vision/src/frame.h"

namespace trailcast::vision {
namespace {

// Bounds for the hole: its distance from the picture's middle, its size, and how much of its
// bounding square it fills (a full circle fills 0.785).
constexpr double kFarthestShare = 0.1;
constexpr double kSmallestShare = 0.08;
constexpr double kLargestShare = 0.7;
constexpr double kLeastFilled = 0.70;
constexpr double kMostFilled = 0.86;
constexpr double kLeastSquare = 0.85;  // shorter side to longer side
constexpr double kRim_px = 4.0;        // pixels there are half picture, half dark

struct Donut {
  cv::Point2d centre;
  double inner_px = 0.0;
  double outer_px = 0.0;
};

// Returns the dark region around the picture's middle if it is round.
std::optional<Donut> FindHole(cv::Mat& dark, double outer_px) {
  const cv::Point middle(dark.cols / 2, dark.rows / 2);
  if (dark.at<std::uint8_t>(middle) == 0) return std::nullopt;
  cv::Rect box;
  const int area_px = cv::floodFill(dark, middle, cv::Scalar(128), &box);
  const double longer = std::max(box.width, box.height);
  const double filled = area_px / static_cast<double>(box.area());
  Donut donut;
  donut.inner_px = std::sqrt(area_px / std::numbers::pi);
  donut.outer_px = outer_px;
  donut.centre = {box.x + 0.5 * (box.width - 1), box.y + 0.5 * (box.height - 1)};
  const cv::Point2d off = donut.centre - cv::Point2d(0.5 * (dark.cols - 1), 0.5 * (dark.rows - 1));
  const double share = donut.inner_px / outer_px;
  const bool round = filled > kLeastFilled && filled < kMostFilled &&
                     std::min(box.width, box.height) > kLeastSquare * longer;
  if (!round || cv::norm(off) > kFarthestShare * outer_px || share < kSmallestShare ||
      share > kLargestShare) {
    return std::nullopt;
  }
  return donut;
}

std::optional<Donut> FindDonut(const cv::Mat& frame) {
  const std::optional<cv::Mat> surround = DarkSurround(frame);
  if (!surround) return std::nullopt;
  const cv::Rect lit = cv::boundingRect(*surround == 0);
  cv::Mat dark = DarkPixels(frame);
  return FindHole(dark, 0.25 * (lit.width + lit.height));
}

}  // namespace

struct DonutUnroller::State {
  bool decided = false;
  cv::Mat map_x, map_y;  // empty: no donut
  image::GrayImage panorama;

  void Decide(const cv::Mat& frame);
};

void DonutUnroller::State::Decide(const cv::Mat& frame) {
  decided = true;
  const std::optional<Donut> donut = FindDonut(frame);
  if (!donut) return;
  const double inner_px = donut->inner_px + kRim_px;
  const double outer_px = donut->outer_px - kRim_px;
  const double px_per_rad = frame.cols / std::numbers::pi;
  // The height is right half way between the rims, where the panorama keeps its proportions.
  const int height =
      std::max(1, cvRound((outer_px - inner_px) * px_per_rad / (0.5 * (inner_px + outer_px))));
  map_x.create(height, frame.cols, CV_32FC1);
  map_y.create(height, frame.cols, CV_32FC1);
  for (int y = 0; y < height; ++y) {
    const double radius_px = outer_px - (y + 0.5) / height * (outer_px - inner_px);
    for (int x = 0; x < frame.cols; ++x) {
      const double bearing_rad = (x - 0.5 * (frame.cols - 1)) / px_per_rad;
      map_x.at<float>(y, x) =
          static_cast<float>(donut->centre.x + radius_px * std::sin(bearing_rad));
      map_y.at<float>(y, x) =
          static_cast<float>(donut->centre.y - radius_px * std::cos(bearing_rad));
    }
  }
  panorama.width = frame.cols;
  panorama.height = height;
  panorama.pixels.resize(image::PixelIndex(0, height, frame.cols));
}

DonutUnroller::DonutUnroller() : state_(std::make_unique<State>()) {}
DonutUnroller::~DonutUnroller() = default;
DonutUnroller::DonutUnroller(DonutUnroller&&) noexcept = default;
DonutUnroller& DonutUnroller::operator=(DonutUnroller&&) noexcept = default;

const image::GrayImage& DonutUnroller::Unroll(const image::GrayImage& frame) {
  State& s = *state_;
  if (!s.decided) s.Decide(View(frame));
  if (s.map_x.empty()) return frame;
  cv::Mat panorama = View(s.panorama);
  cv::remap(View(frame), panorama, s.map_x, s.map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return s.panorama;
}

}  // namespace trailcast::vision
