#include "services/vision/feature_tracker.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "services/vision/src/appearance.h"
#include "services/vision/src/frame.h"
#include "services/vision/src/lens_surround.h"

namespace trailcast::vision {
namespace {

using Pyramid = std::vector<cv::Mat>;

const cv::TermCriteria kFlowEnd(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.02);
constexpr double kFlowMinEigenvalue = 1e-4;
constexpr double kLargestWindow = 3.0;   // times the usual one
constexpr double kMiddleSpacing = 0.5;   // of the spacing on a regular grid
constexpr double kMiddleQuality = 0.05;  // of the best corner that is left there
constexpr int kSurroundEvery = 8;        // frames, because a surround stays dark for long
constexpr int kEdge_px = 4;  // features are dropped a little before they reach the frame's edge

// A corner must stand out of the sensor's noise (2 to 3 grey levels, a third of that once
// smoothed).
constexpr double kMinContrast_grey = 4.0;

struct Flow {
  std::vector<cv::Point2f> points;
  std::vector<std::uint8_t> found;
};

cv::Point2f MedianOf(const std::vector<cv::Point2f>& points) {
  if (points.empty()) return {};
  const auto median = [&](float cv::Point2f::*coordinate) {
    std::vector<float> values;
    values.reserve(points.size());
    for (const cv::Point2f& point : points) values.push_back(point.*coordinate);
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  return {median(&cv::Point2f::x), median(&cv::Point2f::y)};
}

// Says whether there is more than noise around the point.
bool StandsOut(const cv::Mat& smoothed, cv::Point2f point, int window_px) {
  const cv::Rect around = cv::Rect(cvRound(point.x) - window_px / 2,
                                   cvRound(point.y) - window_px / 2, window_px, window_px) &
                          cv::Rect({0, 0}, smoothed.size());
  cv::Scalar mean;
  cv::Scalar sigma;
  cv::meanStdDev(smoothed(around), mean, sigma);
  return sigma[0] >= kMinContrast_grey;
}

}  // namespace

struct FeatureTracker::State {
  FeatureTrackerOptions options;
  Pyramid last;  // of the last frame; empty before the first
  Pyramid next;  // kept for its memory
  std::vector<int> ids;
  std::vector<cv::Point2f> points;  // OpenCV pixel coordinates in the last frame
  TrackLosses losses;
  LensSurround surround;
  int frames = 0;

  int window_px = 0;
  int pyramid_levels = 0;

  [[nodiscard]] cv::Size window() const { return {window_px, window_px}; }
  void Build(const cv::Mat& frame, Pyramid& pyramid) const;
  [[nodiscard]] Flow FlowTo(const Pyramid& from, const Pyramid& to,
                            const std::vector<cv::Point2f>& start,
                            const std::vector<cv::Point2f>& guess) const;
  [[nodiscard]] std::vector<cv::Point2f> Turned(double turned_rad) const;
  void KeepThoseThatReturn(const Flow& forward, const Flow& backward);
  void DetectInTheMiddle(const cv::Mat& frame, const cv::Mat& where, int wanted);
  [[nodiscard]] std::vector<route::TrackedFeature> Current() const;
};

void FeatureTracker::State::Build(const cv::Mat& frame, Pyramid& pyramid) const {
  cv::buildOpticalFlowPyramid(frame, pyramid, window(), pyramid_levels,
                              /*withDerivatives=*/true, cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT,
                              /*tryReuseInputImage=*/false);
}

Flow FeatureTracker::State::FlowTo(const Pyramid& from, const Pyramid& to,
                                   const std::vector<cv::Point2f>& start,
                                   const std::vector<cv::Point2f>& guess) const {
  Flow flow{guess, {}};
  cv::calcOpticalFlowPyrLK(from, to, start, flow.points, flow.found, cv::noArray(), window(),
                           pyramid_levels, kFlowEnd, cv::OPTFLOW_USE_INITIAL_FLOW,
                           kFlowMinEigenvalue);
  return flow;
}

// Returns where the features are after a turn, if it moves them far.
std::vector<cv::Point2f> FeatureTracker::State::Turned(double turned_rad) const {
  std::vector<cv::Point2f> guess = points;
  const double right_px = turned_rad * options.turn_share * last.front().cols;
  if (std::abs(right_px) < options.turn_least_px) return guess;
  for (cv::Point2f& point : guess) point.x += static_cast<float>(right_px);
  return guess;
}

void FeatureTracker::State::KeepThoseThatReturn(const Flow& forward, const Flow& backward) {
  const cv::Size size = last.front().size();
  const cv::Rect2f inside(kEdge_px, kEdge_px, static_cast<float>(size.width - 2 * kEdge_px),
                          static_cast<float>(size.height - 2 * kEdge_px));
  std::vector<cv::Point2f> moved;
  std::vector<cv::Point2f> gone;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool returned = forward.found[i] != 0 && backward.found[i] != 0 &&
                          cv::norm(backward.points[i] - points[i]) <= options.forward_backward_px;
    if (!returned || !inside.contains(forward.points[i])) {
      gone.push_back(points[i]);
      continue;
    }
    moved.push_back(forward.points[i] - points[i]);
    ids[kept] = ids[i];
    points[kept] = forward.points[i];
    ++kept;
  }
  ids.resize(kept);
  points.resize(kept);
  // Nobody knows where a lost feature went, but the others' motion tells whether it can be in view.
  const cv::Point2f shift = MedianOf(moved);
  losses.left_picture = static_cast<int>(std::count_if(
      gone.begin(), gone.end(), [&](cv::Point2f at) { return !inside.contains(at + shift); }));
  losses.not_returned = static_cast<int>(gone.size()) - losses.left_picture;
}

// Adds features in the picture's middle until there are as many as wanted.
void FeatureTracker::State::DetectInTheMiddle(const cv::Mat& frame, const cv::Mat& where,
                                              int wanted) {
  const cv::Size size(cvRound(options.middle_share * frame.cols),
                      cvRound(options.middle_share * frame.rows));
  const cv::Rect middle({(frame.cols - size.width) / 2, (frame.rows - size.height) / 2}, size);
  const auto there =
      static_cast<int>(std::count_if(points.begin(), points.end(), [&](const cv::Point2f& point) {
        return middle.contains(point);
      }));
  const int missing = wanted - there;
  if (missing <= 0) return;
  const double spacing_px = kMiddleSpacing * std::sqrt(middle.area() / wanted);
  cv::Mat free = cv::Mat::zeros(frame.size(), CV_8UC1);
  where(middle).copyTo(free(middle));
  for (const cv::Point2f& point : points) {
    cv::circle(free, point, cvRound(spacing_px), cv::Scalar(0), cv::FILLED);
  }
  std::vector<cv::Point2f> more;
  cv::goodFeaturesToTrack(frame, more, missing, kMiddleQuality, spacing_px, free,
                          options.window_px);
  points.insert(points.end(), more.begin(), more.end());
}

std::vector<route::TrackedFeature> FeatureTracker::State::Current() const {
  std::vector<route::TrackedFeature> features;
  if (last.empty()) return features;
  const cv::Point2f centre = Centre(last.front().size());
  features.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    features.push_back({ids[i], points[i].x - centre.x, points[i].y - centre.y});
  }
  return features;
}

FeatureTracker::FeatureTracker(const FeatureTrackerOptions& options)
    : state_(std::make_unique<State>()) {
  state_->options = options;
  state_->window_px = options.window_px;
  state_->pyramid_levels = options.pyramid_levels;
}

FeatureTracker::~FeatureTracker() = default;
FeatureTracker::FeatureTracker(FeatureTracker&&) noexcept = default;
FeatureTracker& FeatureTracker::operator=(FeatureTracker&&) noexcept = default;

std::vector<route::TrackedFeature> FeatureTracker::Track(const image::GrayImage& frame,
                                                         double turned_rad) {
  State& s = *state_;
  s.Build(View(frame), s.next);
  if (s.frames++ % kSurroundEvery == 0) s.surround.Add(View(frame));
  s.losses = {};
  if (!s.points.empty()) {
    const Flow forward = s.FlowTo(s.last, s.next, s.points, s.Turned(turned_rad));
    const Flow backward = s.FlowTo(s.next, s.last, forward.points, s.points);
    s.KeepThoseThatReturn(forward, backward);
  }
  std::swap(s.last, s.next);
  return s.Current();
}

std::vector<route::TrackedFeature> FeatureTracker::Detect(int in_the_middle) {
  State& s = *state_;
  const cv::Mat& frame = s.last.front();
  const double spacing_px =
      s.options.min_spacing_share *
      std::sqrt(static_cast<double>(frame.total()) / std::max(1, s.options.max_features));
  cv::Mat where = s.surround.FieldOfView();
  const int edge_px = route::kPatchSize / 2 + 2;
  cv::rectangle(where, {0, 0}, {frame.cols - 1, frame.rows - 1}, cv::Scalar(0), 2 * edge_px);
  cv::goodFeaturesToTrack(frame, s.points, s.options.max_features, s.options.detection_quality,
                          spacing_px, where, s.options.window_px);
  if (in_the_middle > 0) s.DetectInTheMiddle(frame, where, in_the_middle);
  cv::Mat smoothed;
  cv::blur(frame, smoothed, cv::Size(3, 3));
  std::erase_if(s.points, [&](const cv::Point2f& point) {
    return !StandsOut(smoothed, point, s.options.window_px);
  });
  s.ids.resize(s.points.size());
  for (std::size_t i = 0; i < s.ids.size(); ++i) s.ids[i] = static_cast<int>(i);
  return s.Current();
}

void FeatureTracker::Follow(const std::vector<route::TrackedFeature>& features) {
  State& s = *state_;
  const cv::Point2f centre = Centre(s.last.front().size());
  s.ids.clear();
  s.points.clear();
  for (const route::TrackedFeature& feature : features) {
    s.ids.push_back(feature.id);
    s.points.emplace_back(static_cast<float>(feature.u_px) + centre.x,
                          static_cast<float>(feature.v_px) + centre.y);
  }
}

void FeatureTracker::SetMagnification(double magnification) {
  State& s = *state_;
  const double larger = std::clamp(magnification, 1.0, kLargestWindow);
  const int window_px =
      2 * static_cast<int>(0.5 * cvRound(larger * s.options.window_px)) + 1;  // odd
  if (window_px == s.window_px) return;
  s.window_px = window_px;
  s.pyramid_levels = s.options.pyramid_levels - static_cast<int>(std::lround(std::log2(larger)));
  if (!s.last.empty()) s.Build(s.last.front().clone(), s.last);
}

std::vector<route::TrackedFeature> FeatureTracker::Current() const { return state_->Current(); }

int FeatureTracker::count() const { return static_cast<int>(state_->points.size()); }

TrackLosses FeatureTracker::losses() const { return state_->losses; }

std::vector<route::DescribedFeature> FeatureTracker::Describe(double magnification) const {
  const cv::Mat& own = state_->last.front();
  cv::Mat resized;
  if (magnification != 1.0) {
    cv::resize(own, resized, {}, 1.0 / magnification, 1.0 / magnification,
               magnification > 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  }
  const auto place_of = [&](const cv::Point2f& point) {
    if (resized.empty()) return point;
    return Centre(resized.size()) +
           (point - Centre(own.size())) * (1.0F / static_cast<float>(magnification));
  };
  const std::vector<route::TrackedFeature> current = state_->Current();
  std::vector<route::DescribedFeature> described;
  for (std::size_t i = 0; i < current.size(); ++i) {
    const auto patch = CutPatch(resized.empty() ? own : resized, place_of(state_->points[i]));
    if (patch) described.push_back({current[i], *patch});
  }
  return described;
}

}  // namespace trailcast::vision
