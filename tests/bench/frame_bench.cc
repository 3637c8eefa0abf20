// This measures what a frame costs a follower without and with odometry, beside the bare OpenCV
// calls that every follower needs, in turn in one run. See docs/reference/figures/speed.md.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>
#include <vector>

#include "agent/session/replay_session.h"
#include "agent/session/teach_session.h"
#include "services/base/median.h"
#include "services/image/files.h"
#include "services/lab/sim/core/judge.h"
#include "services/lab/sim/core/path_follow_driver.h"
#include "services/lab/sim/core/simulated_robot.h"
#include "services/lab/sim/places/place.h"
#include "services/program/heap.h"
#include "services/vision/picture_intake.h"
#include "services/vision/src/frame.h"
#include "tests/bench/must.h"

namespace trailcast {
namespace {

using bench::Must;

constexpr std::size_t kFrames = 200;
constexpr double kRate_hz = 30.0;

using Drive = std::vector<agent::Observation>;

// Along a built-in place's path; `seed` draws the wheels' slip, the exposure and the noise.
Drive DriveWith(int width, int height, std::uint64_t seed, std::size_t frames = kFrames) {
  sim::PlaceOptions where;
  where.world = "desks";
  const sim::Place place = Must(sim::OpenPlace(where));
  sim::SimulatedRobotOptions options;
  options.camera = Must(sim::FindCamera("webcam"));
  options.camera.width = width;
  options.camera.height = height;
  options.start = sim::StartPose(place.path);
  options.seed = seed;
  options.rate_hz = kRate_hz;
  const auto robot = Must(sim::SimulatedRobot::Create(place.world, options));
  const sim::Judge judge(*robot);
  sim::PathFollowDriver driver(place.path.points);
  motion::VelocityCommand command;
  Drive drive;
  while (drive.size() < frames && !driver.arrived()) {
    sim::Observation seen = robot->Step(command);
    drive.push_back({seen.stamp, std::move(seen.image), seen.odometry});
    command = driver.Command(judge.true_pose());
  }
  return drive;
}

Drive WithoutOdometry(Drive drive) {
  for (agent::Observation& each : drive) each.odometry.reset();
  return drive;
}

// A follower of what `drive` teaches.
agent::ReplaySession FollowerOf(const Drive& drive) {
  agent::TeachSession teach;
  std::vector<route::Segment> taught;
  for (const agent::Observation& each : drive) {
    auto step = Must(teach.Observe(each));
    if (step.finished) taught.push_back(std::move(*step.finished));
  }
  if (auto last = teach.Finish()) taught.push_back(std::move(*last));
  const vision::PictureSize size =
      vision::WorkingSize({drive.front().image.width, drive.front().image.height});
  route::RouteInfo info;
  info.image_width_px = size.width;
  info.image_height_px = size.height;
  agent::ReplaySession session({}, info);
  for (route::Segment& segment : taught) {
    if (auto added = session.AddSegment(std::move(segment)); !added) std::abort();
  }
  return session;
}

// Reduced to 320 pixels' width, a pyramid, flow of a hundred corners, 300 upright ORB features at
// 240x180. Buffers are kept; corners are looked for where few are left, and not counted.
class BareCalls {
 public:
  void See(const image::GrayImage& frame) {
    const cv::Mat picture = vision::View(frame);
    const cv::Mat small = Resized(picture, 320.0 / frame.width, small_);
    cv::buildOpticalFlowPyramid(small, next_, kWindow, kLevels);
    if (!corners_.empty()) {
      cv::calcOpticalFlowPyrLK(last_, next_, corners_, there_, found_, error_, kWindow, kLevels);
    }
    std::swap(last_, next_);
    const cv::Mat view = Resized(
        picture, std::sqrt(240.0 * 180.0 / static_cast<double>(picture.total())), view_, true);
    orb_->detect(view, keys_);
    for (cv::KeyPoint& key : keys_) key.angle = 0.0F;
    orb_->compute(view, keys_, descriptors_);
    benchmark::DoNotOptimize(descriptors_.data);
  }

  void TakeCorners() {
    corners_.clear();
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (found_[i] != 0) corners_.push_back(there_[i]);
    }
    found_.clear();
    if (corners_.size() >= kCorners / 2) return;
    const cv::Mat& inner = last_.front();
    cv::goodFeaturesToTrack(inner, corners_, kCorners, 0.01, 7.0);
  }

 private:
  static constexpr int kCorners = 100;
  static constexpr int kLevels = 3;
  inline static const cv::Size kWindow{7, 7};

  static cv::Mat Resized(const cv::Mat& picture, double scale, cv::Mat& kept, bool larger = false) {
    if (scale >= 1.0 && !larger) return picture;
    cv::resize(picture, kept, {}, scale, scale, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
    return kept;
  }

  cv::Mat small_;
  cv::Mat view_;
  cv::Mat descriptors_;
  std::vector<cv::Mat> last_;
  std::vector<cv::Mat> next_;
  std::vector<cv::Point2f> corners_;
  std::vector<cv::Point2f> there_;
  std::vector<std::uint8_t> found_;
  std::vector<float> error_;
  std::vector<cv::KeyPoint> keys_;
  cv::Ptr<cv::ORB> orb_ = cv::ORB::create(300, 1.2F, 6, 17, 0, 2, cv::ORB::HARRIS_SCORE, 31, 7);
};

// OpenCV's threads included.
double ProcessCpuMs() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// In processor time, of frames.
class Cost {
 public:
  template <typename Work>
  void Add(const Work& work) {
    const double begun_ms = ProcessCpuMs();
    work();
    frames_ms_.push_back(ProcessCpuMs() - begun_ms);
  }
  [[nodiscard]] double median_ms() const { return Median(frames_ms_); }
  [[nodiscard]] double mean_ms() const {
    return std::accumulate(frames_ms_.begin(), frames_ms_.end(), 0.0) /
           static_cast<double>(frames_ms_.size());
  }

 private:
  std::vector<double> frames_ms_;
};

// One iteration is a drive of so many frames.
void Frame(benchmark::State& state) {
  const auto width = static_cast<int>(state.range(0));
  const auto height = static_cast<int>(state.range(1));
  const Drive with = DriveWith(width, height, 2);
  const Drive without = WithoutOdometry(with);
  const Drive taught = DriveWith(width, height, 1);
  const Drive taught_without = WithoutOdometry(taught);
  Cost bare_cost;
  Cost without_cost;
  Cost with_cost;
  int following = 0;
  int following_with = 0;
  const auto follows = [](const Result<agent::ReplayStep>& step) {
    return step && step->state == agent::ReplayState::kFollowing ? 1 : 0;
  };
  for ([[maybe_unused]] auto _ : state) {
    BareCalls bare;
    agent::ReplaySession by_views = FollowerOf(taught_without);
    agent::ReplaySession by_features = FollowerOf(taught);
    for (std::size_t i = 0; i < with.size(); ++i) {
      bare_cost.Add([&] { bare.See(with[i].image); });
      bare.TakeCorners();
      without_cost.Add([&] { following += follows(by_views.Observe(without[i])); });
      with_cost.Add([&] { following_with += follows(by_features.Observe(with[i])); });
    }
  }
  const double frames = static_cast<double>(with.size() * state.iterations());
  state.counters["bare_ms"] = bare_cost.median_ms();
  state.counters["without_ms"] = without_cost.median_ms();
  state.counters["with_ms"] = with_cost.median_ms();
  state.counters["bare_mean_ms"] = bare_cost.mean_ms();
  state.counters["without_mean_ms"] = without_cost.mean_ms();
  state.counters["with_mean_ms"] = with_cost.mean_ms();
  state.counters["without_follows"] = following / frames;
  state.counters["with_follows"] = following_with / frames;
}
BENCHMARK(Frame)
    ->Args({160, 120})
    ->Args({640, 360})
    ->Args({1280, 720})
    ->Iterations(2)
    ->Unit(benchmark::kSecond);

// This compares two ways to bring a camera's JPEG to the size that is looked at: the whole picture
// is decoded and then reduced, or it is reduced while it is decoded.
void Jpeg(benchmark::State& state) {
  constexpr int kQuality = 90;
  constexpr std::size_t kPictures = 20;
  const Drive drive =
      DriveWith(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 1, kPictures);
  std::vector<std::vector<std::uint8_t>> jpegs;
  std::size_t bytes = 0;
  for (const agent::Observation& each : drive) {
    jpegs.push_back(Must(image::EncodeJpeg(each.image, kQuality)));
    bytes += jpegs.back().size();
  }
  image::PictureRun whole_run;
  image::PictureRun reduced_run(vision::kEnoughPx);
  vision::PictureIntake intake;
  Cost whole;
  Cost reduced;
  const auto read = [&](const std::vector<std::uint8_t>& jpeg, image::PictureRun& run) {
    const image::GrayImage picture = Must(image::DecodeGray(jpeg, "it", run));
    benchmark::DoNotOptimize(intake.Reduce(picture).pixels.data());
  };
  for ([[maybe_unused]] auto _ : state) {
    for (const auto& jpeg : jpegs) {
      whole.Add([&] { read(jpeg, whole_run); });
      reduced.Add([&] { read(jpeg, reduced_run); });
    }
  }
  state.counters["kB"] = 1e-3 * static_cast<double>(bytes) / static_cast<double>(jpegs.size());
  state.counters["whole_ms"] = whole.median_ms();
  state.counters["reduced_ms"] = reduced.median_ms();
}
BENCHMARK(Jpeg)->Args({1280, 720})->Args({1920, 1080})->Iterations(5)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace trailcast

int main(int argc, char** argv) {
  trailcast::program::KeepFreedMemory();  // as the agent does
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
