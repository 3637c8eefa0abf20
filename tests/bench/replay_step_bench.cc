// One replay step at 320x240 with 60 features, beside the bare OpenCV calls that it cannot do
// without, and the hand-over. See README.md.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "agent/diagnosis/snapshot_view.h"
#include "agent/session/hand_over.h"
#include "agent/session/replay_session.h"
#include "agent/session/teach_session.h"
#include "services/image/files.h"
#include "services/replay/funnel_follower.h"
#include "services/replay/path_follower.h"
#include "services/teach/segment_recorder.h"
#include "services/vision/feature_tracker.h"
#include "services/vision/src/frame.h"
#include "tests/support/painted_wall.h"

namespace trailcast {
namespace {

constexpr int kFrames = 16;  // there and back again, so that features are never lost for good

// A camera that closes in on a wall and backs off again.
const std::vector<image::GrayImage>& Frames() {
  static const std::vector<image::GrayImage> frames = [] {
    const test::PaintedWall wall(3);
    std::vector<image::GrayImage> made;
    for (unsigned i = 0; i < kFrames; ++i) {
      const double phase = i < kFrames / 2 ? i : kFrames - i;
      made.push_back(wall.Photograph(
          {.scale = 1.0 + 0.01 * phase, .du_px = 0.8 * phase, .noise_grey = 2.0, .noise_seed = i}));
    }
    return made;
  }();
  return frames;
}

route::Segment TaughtSegment() {
  vision::FeatureTracker tracker;
  teach::SegmentRecorder recorder(320);
  tracker.Track(Frames().front());
  tracker.Detect();
  recorder.Begin(SensorTime{0}, tracker.Describe(), motion::Pose2{});
  for (std::size_t i = 1; i < kFrames / 2; ++i) {
    const double x_m = 0.25 * static_cast<double>(i);  // long enough to keep every feature
    const auto event =
        recorder.Add(FromSeconds(x_m), tracker.Track(Frames()[i]), motion::Pose2{x_m, 0.0, 0.0});
    if (event != teach::SegmentRecorder::Event::kGoesOn) break;
  }
  return *recorder.Finish();
}

void BareOpenCv(benchmark::State& state) {
  vision::FeatureTracker detector;
  detector.Track(Frames().front());
  const cv::Point2f centre = vision::Centre({320, 240});
  std::vector<cv::Point2f> start;
  for (const auto& feature : detector.Detect()) {
    start.emplace_back(static_cast<float>(feature.u_px) + centre.x,
                       static_cast<float>(feature.v_px) + centre.y);
  }
  const cv::Size window(7, 7);
  const cv::TermCriteria end(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.02);
  std::vector<cv::Mat> last;
  std::vector<cv::Mat> next;
  cv::buildOpticalFlowPyramid(vision::View(Frames().back()), last, window, 3, true,
                              cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    cv::buildOpticalFlowPyramid(vision::View(Frames()[i++ % kFrames]), next, window, 3, true,
                                cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
    std::vector<cv::Point2f> there = start;
    std::vector<cv::Point2f> back = start;
    std::vector<std::uint8_t> found;
    cv::calcOpticalFlowPyrLK(last, next, start, there, found, cv::noArray(), window, 3, end,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    cv::calcOpticalFlowPyrLK(next, last, there, back, found, cv::noArray(), window, 3, end,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    benchmark::DoNotOptimize(back);
    std::swap(last, next);
  }
  state.counters["features"] = static_cast<double>(start.size());
}
BENCHMARK(BareOpenCv)->Unit(benchmark::kMillisecond);

template <typename Follower>
void ReplayStep(benchmark::State& state) {
  vision::FeatureTracker tracker;
  tracker.Track(Frames().front());
  std::vector<route::TrackedFeature> features = tracker.Detect();
  // A segment that holds all sixty, so that every one of them is tracked, unrolled and asked.
  route::Segment segment;
  segment.has_odometry = true;
  segment.length_m = 1000.0;
  segment.duration_s = 2000.0;
  for (const auto& feature : features) {
    const auto u = static_cast<float>(feature.u_px);
    const auto v = static_cast<float>(feature.v_px);
    segment.features.push_back({{}, {}, {{0.0F, u, v}, {1.0F, 1.1F * u, 1.1F * v}}});
  }
  Follower follower(320, 1.0);
  follower.Begin(segment);
  std::size_t i = 0;
  double tracked = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    if (i % kFrames == 0) tracker.Follow(features);
    const auto now = tracker.Track(Frames()[i++ % kFrames]);
    tracked += static_cast<double>(now.size());
    benchmark::DoNotOptimize(follower.Step({now, motion::OdometryIncrement{0.001, 0.0}}));
  }
  state.counters["features"] = tracked / static_cast<double>(state.iterations());
}
BENCHMARK_TEMPLATE(ReplayStep, replay::FunnelFollower)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(ReplayStep, replay::PathFollower)->Unit(benchmark::kMillisecond);

void HandOverNear(benchmark::State& state) {
  const route::Segment segment = TaughtSegment();
  agent::HandOver hand_over(true, 320);
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    replay::PathFollower follower(320, 1.0);
    follower.Begin(segment);
    state.ResumeTiming();
    benchmark::DoNotOptimize(
        hand_over.ToSegment(Frames()[3], follower, [] { return std::nullopt; }));
  }
  state.counters["found_share"] = hand_over.found_share();
  state.counters["sought"] = static_cast<double>(segment.features.size());
}
BENCHMARK(HandOverNear)->Unit(benchmark::kMillisecond);

void SearchByPatternsAtAnyMagnification(benchmark::State& state) {
  const route::Segment segment = TaughtSegment();
  const vision::FeatureFinder finder;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(
        finder.FindAtAnyMagnification(Frames()[3], segment.features, 0.0, {45.0, 22.5}));
  }
}
BENCHMARK(SearchByPatternsAtAnyMagnification)->Unit(benchmark::kMillisecond);

constexpr double kWholeStep_m = 0.001;

// On a route of so many metres: the first segment's features and key views again and again, so that
// any of it might be the place.
agent::ReplaySession SessionOn(double length_m, bool odometry) {
  agent::TeachSession teach;
  std::vector<route::Segment> taught;
  for (unsigned i = 0; i < kFrames; ++i) {
    const auto pose = odometry ? std::optional(motion::Pose2{0.25 * i, 0.0, 0.0}) : std::nullopt;
    auto step = teach.Observe({FromSeconds(i / 15.0), Frames()[i], pose});
    if (step && step->finished) taught.push_back(std::move(*step->finished));
  }
  if (auto last = teach.Finish()) taught.push_back(std::move(*last));
  route::RouteInfo info;
  info.image_width_px = Frames().front().width;
  info.image_height_px = Frames().front().height;
  agent::ReplaySession session({}, info);
  double length = 0.0;
  for (std::uint32_t i = 0; length < length_m; ++i) {
    route::Segment segment = taught[i % taught.size()];
    segment.index = SegmentIndex(i);
    length += odometry ? segment.length_m : 0.3 * segment.duration_s;
    if (!session.AddSegment(std::move(segment))) std::abort();
  }
  return session;
}

Result<agent::ReplayStep> Step(agent::ReplaySession& session, unsigned i, bool odometry) {
  const auto pose =
      odometry ? std::optional(motion::Pose2{kWholeStep_m * i, 0.0, 0.0}) : std::nullopt;
  return session.Observe({FromSeconds(i / 30.0), Frames()[i % kFrames], pose});
}

// All that a follower does with a frame.
void WholeStep(benchmark::State& state, bool odometry) {
  agent::ReplaySession session = SessionOn(static_cast<double>(state.range(0)), odometry);
  unsigned i = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(Step(session, i++, odometry));
  }
}
BENCHMARK_CAPTURE(WholeStep, WithOdometry, true)
    ->Arg(10)
    ->Arg(1000)
    ->Arg(10'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(WholeStep, WithoutOdometry, false)
    ->Arg(10)
    ->Arg(1000)
    ->Arg(10'000)
    ->Unit(benchmark::kMillisecond);

// This measures what the control loop pays for a frame that somebody looks at.
void HandOverASnapshot(benchmark::State& state) {
  agent::ReplaySession session = SessionOn(10.0, true);
  // The session looks at a frame that is still there, as in the loop.
  const agent::Observation observation{FromSeconds(0.0), Frames()[0], motion::Pose2{}};
  const auto step = session.Observe(observation);
  for ([[maybe_unused]] auto _ : state) {
    agent::SnapshotFrame frame{*session.picture(), session.ViewFeatures(*step), step->sight.stored,
                               step->turn_rad};
    benchmark::DoNotOptimize(frame);
  }
  state.counters["features"] = static_cast<double>(session.ViewFeatures(*step).size());
}
BENCHMARK(HandOverASnapshot)->Unit(benchmark::kMillisecond);

// And a thread that gives way to it.
void MakeASnapshot(benchmark::State& state) {
  agent::ReplaySession session = SessionOn(10.0, true);
  const agent::Observation observation{FromSeconds(0.0), Frames()[0], motion::Pose2{}};
  const auto step = session.Observe(observation);
  const agent::SnapshotFrame frame{*session.picture(), session.ViewFeatures(*step),
                                   step->sight.stored, step->turn_rad};
  std::size_t bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    bytes = image::EncodeJpeg(agent::DrawSnapshot(frame), 70)->size();
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(MakeASnapshot)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trailcast

BENCHMARK_MAIN();
