// A whole replay, by any method, with and without odometry, fed with pictures of all kinds: the
// route's own in any order, noise, darkness, glare, other sizes and shapes, nothing at all.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "agent/session/replay_session.h"
#include "agent/session/teach_session.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/walk_frames.h"

namespace {

using namespace trailcast;
using fuzz::Require;

constexpr int kWidth = 128;
constexpr int kHeight = 96;
constexpr int kFrames = 30;
constexpr double kStep_m = 0.05;
constexpr std::size_t kMostSteps = 40;

const image::GrayImage& Picture(int frame) {
  static const std::vector<image::GrayImage> pictures = [] {
    std::vector<image::GrayImage> made;
    for (int i = 0; i < kFrames; ++i) made.push_back(test::WalkFrame(i, kWidth, kHeight));
    return made;
  }();
  return pictures[static_cast<std::size_t>(frame)];
}

SensorTime StampOf(int frame) { return FromSeconds(frame / 15.0); }

std::optional<motion::Pose2> PoseAt(double step, bool odometry) {
  if (!odometry) return std::nullopt;
  return motion::Pose2{kStep_m * step, 0.0, 0.0};
}

std::vector<route::Segment> Teach(bool odometry) {
  agent::TeachSession session;
  std::vector<route::Segment> segments;
  for (int i = 0; i < kFrames; ++i) {
    auto step = session.Observe({StampOf(i), Picture(i), PoseAt(i, odometry)});
    Require(step.has_value(), "the walk can be taught");
    if (step->finished) segments.push_back(std::move(*step->finished));
  }
  if (auto last = session.Finish()) segments.push_back(std::move(*last));
  Require(!segments.empty(), "the walk is a route");
  return segments;
}

const std::vector<route::Segment>& Taught(bool odometry) {
  static const std::vector<route::Segment> with = Teach(true);
  static const std::vector<route::Segment> without = Teach(false);
  return odometry ? with : without;
}

image::GrayImage Plain(int width, int height, std::uint8_t grey) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height), grey)};
}

image::GrayImage Noise(std::uint8_t seed) {
  image::GrayImage picture = Plain(kWidth, kHeight, 0);
  std::mt19937 random(seed);
  for (std::uint8_t& pixel : picture.pixels) pixel = static_cast<std::uint8_t>(random());
  return picture;
}

image::GrayImage Kind(std::uint8_t kind, std::uint8_t value, int next) {
  switch (kind % 10) {
    case 0:
      return Noise(value);
    case 1:
      return Plain(kWidth, kHeight, value);
    case 2:
      return Picture(value % kFrames);  // a cut
    case 3:
      return test::WalkFrame(value % kFrames, kWidth / 2, kHeight / 2);
    case 4:
      return test::WalkFrame(value % kFrames, kHeight, kWidth);
    case 5:
      return Plain(1 + value % 40, 1 + value % 7, value);
    case 6:
      return {};
    case 7: {  // saturated but for a part
      image::GrayImage picture = Picture(value % kFrames);
      for (std::uint8_t& pixel : picture.pixels) {
        pixel = static_cast<std::uint8_t>(std::min(255, 4 * pixel));
      }
      return picture;
    }
    default:
      return Picture(next);
  }
}

bool Finite(const agent::ReplayStep& step) {
  return std::isfinite(step.command.linear_mps) && std::isfinite(step.command.angular_radps) &&
         std::isfinite(step.turn_rad) && std::isfinite(step.magnification) &&
         std::isfinite(step.progress);
}

}  // namespace

// The first byte: how the route is followed; then two for each frame, what it shows.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return 0;
  const std::span<const std::uint8_t> input(data, size);
  const bool taught_with_odometry = (input[0] & 1U) != 0;
  const bool odometry = (input[0] & 2U) != 0;
  agent::ReplayMethodOptions options;
  options.method = (input[0] & 4U) != 0   ? agent::ReplayMethod::kPaper
                   : (input[0] & 8U) != 0 ? agent::ReplayMethod::kIcra2006
                                          : agent::ReplayMethod::kDefault;
  route::RouteInfo info;
  info.image_width_px = kWidth;
  info.image_height_px = kHeight;
  agent::ReplaySession session(options, info);
  for (const route::Segment& segment : Taught(taught_with_odometry)) {
    Require(session.AddSegment(segment).has_value(), "segments come in order");
  }
  session.MarkComplete();
  const std::size_t steps = std::min(kMostSteps, (size - 1) / 2);
  for (std::size_t i = 0; i < steps; ++i) {
    const int next = static_cast<int>(i) % kFrames;
    const auto step = session.Observe({StampOf(static_cast<int>(i)),
                                       Kind(input[1 + 2 * i], input[2 + 2 * i], next),
                                       PoseAt(static_cast<double>(i), odometry)});
    Require(step.has_value(), "no picture ends a replay");
    Require(Finite(*step), "what it asks for is finite");
    Require(std::abs(step->turn_rad) <= M_PI, "no robot turns further than that");
    const bool drives =
        step->state == agent::ReplayState::kFollowing || step->state == agent::ReplayState::kBlind;
    Require(drives || (step->command.linear_mps == 0.0 && step->command.angular_radps == 0.0),
            "a robot that does not follow stands");
  }
  return 0;
}
