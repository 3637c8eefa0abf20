#include "services/vision/view_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "services/route/view.h"
#include "services/view/view_table.h"
#include "services/vision/donut.h"
#include "services/vision/src/frame.h"
#include "services/vision/src/lens_surround.h"

namespace trailcast::vision {
namespace {

constexpr int kOrbPatch_px = 31;
constexpr int kOrbEdge_px = 17;
constexpr int kSmallestSide_px = 40;  // of the reduced picture: ORB's patch has 31

// Returns the size to which every picture is reduced.
cv::Size CommonSize(cv::Size frame, int pixels) {
  const double shrink = std::sqrt(pixels / static_cast<double>(frame.area()));
  return {cvRound(frame.width * shrink), cvRound(frame.height * shrink)};
}

// Shrinks to that size. A mean over fractions of pixels costs ten times as much as one over two by
// two.
void Shrink(cv::Mat frame, cv::Size size, cv::Mat& shrunk) {
  while (frame.cols >= 2 * size.width && frame.rows >= 2 * size.height && frame.cols % 2 == 0 &&
         frame.rows % 2 == 0) {
    cv::Mat half;
    cv::resize(frame, half, {frame.cols / 2, frame.rows / 2}, 0, 0, cv::INTER_AREA);
    frame = half;
  }
  cv::resize(frame, shrunk, size, 0, 0, cv::INTER_AREA);
}

// Returns nothing for a picture that is too small.
cv::Mat AtCommonSize(const cv::Mat& frame, int pixels) {
  const cv::Size size = CommonSize(frame.size(), pixels);
  if (std::min(size.width, size.height) < kSmallestSide_px) return {};
  // A picture within a pixel of that size may be one that was reduced before.
  if (std::abs(size.width - frame.cols) <= 1 && std::abs(size.height - frame.rows) <= 1) {
    return frame;
  }
  cv::Mat resized;
  if (size.area() < frame.size().area()) {
    Shrink(frame, size, resized);
  } else {
    cv::resize(frame, resized, size, 0, 0, cv::INTER_LINEAR);
  }
  return resized;
}

void SortBySize(route::View& view) {
  std::stable_sort(view.begin(), view.end(),
                   [](const auto& a, const auto& b) { return a.size_px < b.size_px; });
}

}  // namespace

const image::GrayImage& ViewPicture::Reduce(const image::GrayImage& frame) {
  const cv::Size from(frame.width, frame.height);
  if (from.empty()) return frame;
  const cv::Size size = CommonSize(from, ViewFeatureOptions{}.pixels);
  if (size.empty() || size.area() >= from.area()) return frame;
  reduced_.width = size.width;
  reduced_.height = size.height;
  reduced_.pixels.resize(image::PixelIndex(0, size.height, size.width));
  cv::Mat to = View(reduced_);
  Shrink(View(frame), size, to);
  return reduced_;
}

struct ViewDescriber::State {
  ViewFeatureOptions options;
  cv::Ptr<cv::ORB> orb;
  LensSurround surround;
  cv::Size size;  // of the reduced pictures

  [[nodiscard]] cv::Mat Where(const cv::Mat& picture);
};

// Returns where to look for features; an empty mask means everywhere.
cv::Mat ViewDescriber::State::Where(const cv::Mat& picture) {
  if (picture.size() != size) surround = {};  // another camera's, or the same one's turned
  size = picture.size();
  surround.Add(picture);
  return surround.any() ? surround.FieldOfView() : cv::Mat();
}

ViewDescriber::ViewDescriber(const ViewFeatureOptions& options)
    : state_(std::make_unique<State>()) {
  state_->options = options;
  state_->orb =
      cv::ORB::create(options.most_features, options.level_step, options.levels, kOrbEdge_px, 0, 2,
                      cv::ORB::HARRIS_SCORE, kOrbPatch_px, options.least_contrast_grey);
}
ViewDescriber::~ViewDescriber() = default;
ViewDescriber::ViewDescriber(ViewDescriber&&) noexcept = default;
ViewDescriber& ViewDescriber::operator=(ViewDescriber&&) noexcept = default;

route::View ViewDescriber::Describe(const image::GrayImage& frame) {
  if (frame.empty()) return {};
  const cv::Mat picture = AtCommonSize(View(frame), state_->options.pixels);
  if (picture.empty()) return {};
  std::vector<cv::KeyPoint> corners;
  state_->orb->detect(picture, corners, state_->Where(picture));
  for (cv::KeyPoint& corner : corners) corner.angle = 0.0F;
  cv::Mat descriptors;
  state_->orb->compute(picture, corners, descriptors);  // this changes the corners' order
  std::vector<std::size_t> strongest(corners.size());
  std::iota(strongest.begin(), strongest.end(), 0U);
  std::stable_sort(strongest.begin(), strongest.end(), [&](std::size_t a, std::size_t b) {
    return corners[a].response > corners[b].response;
  });
  const cv::Point2f centre = Centre(picture.size());
  const float frame_px = static_cast<float>(frame.width) / static_cast<float>(picture.cols);
  route::View view(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const cv::KeyPoint& corner = corners[strongest[i]];
    const std::uint8_t* bytes = descriptors.ptr<std::uint8_t>(static_cast<int>(strongest[i]));
    std::copy_n(bytes, view[i].descriptor.size(), view[i].descriptor.begin());
    view[i].u_px = frame_px * (corner.pt.x - centre.x);
    view[i].v_px = frame_px * (corner.pt.y - centre.y);
    view[i].size_px =
        frame_px * std::pow(state_->options.level_step, static_cast<float>(corner.octave));
  }
  return view;
}

route::View DescribeForQuery(const image::GrayImage& frame) {
  // Together these cover four octaves and a half, each with a describer's pyramid.
  constexpr std::array kEnlarged = {2.5, 1.21, 0.58, 0.28};
  constexpr int kLevels = 4;
  constexpr std::size_t kAsScouts = 200;
  constexpr int kDescribed = 240;  // of these, features that are spread over the picture are taken
  constexpr std::size_t kOfEach = 160;
  static_assert(kAsScouts + kOfEach * kEnlarged.size() == route::kMaxViewFeatures);
  DonutUnroller unroller;
  const image::GrayImage& picture = unroller.Unroll(frame);
  route::View all = view::Spread(ViewDescriber().Describe(picture), kAsScouts);
  for (route::ViewFeature& feature : all) feature.size_px = 0.0F;
  route::View strong;
  route::View others;
  for (const double enlarged : kEnlarged) {
    ViewFeatureOptions options;
    options.pixels = static_cast<int>(options.pixels * enlarged * enlarged);
    options.most_features = kDescribed;
    options.levels = kLevels;
    const route::View view = view::Spread(ViewDescriber(options).Describe(picture), kOfEach);
    const auto middle = view.begin() + static_cast<std::ptrdiff_t>(view.size() / 2);
    strong.insert(strong.end(), view.begin(), middle);
    others.insert(others.end(), middle, view.end());
  }
  SortBySize(strong);
  SortBySize(others);
  all.insert(all.end(), strong.begin(), strong.end());
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace trailcast::vision
