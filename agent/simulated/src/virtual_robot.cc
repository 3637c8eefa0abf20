#include "agent/simulated/virtual_robot.h"

#include <spdlog/spdlog.h>

#include <array>
#include <charconv>
#include <string_view>
#include <thread>
#include <utility>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Kind = RobotFault::Kind;

constexpr milliseconds kCommandLife{500};
constexpr milliseconds kListen{20};
// In lockstep a frame that nobody answered is said again.
constexpr milliseconds kSayAgain{500};

struct FaultName {
  Kind kind;
  std::string_view name;
};
constexpr std::array kFaultNames{FaultName{Kind::kCameraFreezes, "camera-freezes"},
                                 FaultName{Kind::kCameraStops, "camera-stops"},
                                 FaultName{Kind::kOdometryStops, "odometry-stops"},
                                 FaultName{Kind::kBaseStops, "base-stops"}};

dds::Ros2Image ToRos2(const Observation& seen) {
  const auto width = static_cast<std::uint32_t>(seen.image.width);
  return {.stamp = seen.stamp,
          .width_px = width,
          .height_px = static_cast<std::uint32_t>(seen.image.height),
          .encoding = "mono8",
          .step = width,
          .data = seen.image.pixels};
}

class VirtualRobot {
 public:
  VirtualRobot(SimulatedDevice& robot, dds::Ros2Robot& link, const VirtualRobotOptions& options)
      : robot_(robot), link_(link), options_(options) {}

  [[nodiscard]] Result<void> Run();
  [[nodiscard]] Summary Tell() const;

 private:
  [[nodiscard]] Result<void> Say(const Observation& seen);
  void WaitForAnswer(const Observation& seen);
  void WaitForTick();
  void Hear(const dds::Ros2Command& command);
  [[nodiscard]] bool failed(Kind kind) const {
    return failed_at_ && options_.fault && options_.fault->kind == kind;
  }
  void Fail(steady_clock::time_point now);

  SimulatedDevice& robot_;
  dds::Ros2Robot& link_;
  const VirtualRobotOptions& options_;
  motion::VelocityCommand command_;
  steady_clock::time_point told_at_{};
  std::optional<steady_clock::time_point> drove_at_;          // first told to drive
  std::optional<steady_clock::time_point> failed_at_;         // the fault began
  std::optional<steady_clock::time_point> told_to_stand_at_;  // first after it
  std::vector<std::uint8_t> frozen_;
  steady_clock::time_point next_tick_ = steady_clock::now();
  std::size_t frames_ = 0;
  std::size_t said_again_ = 0;
  std::size_t commands_ = 0;
};

Result<void> VirtualRobot::Run() {
  while (!options_.stop()) {
    const auto now = steady_clock::now();
    Fail(now);
    const bool fresh = options_.lockstep || now - told_at_ <= kCommandLife;
    const bool obeys = fresh && !failed(Kind::kBaseStops);
    if (auto driven = robot_.Drive(obeys ? command_ : motion::VelocityCommand{}); !driven) {
      return driven;
    }
    auto seen = robot_.Next();
    if (!seen) return tl::unexpected(seen.error());
    if (!*seen) return {};
    if (failed(Kind::kCameraFreezes)) {
      if (frozen_.empty()) frozen_ = (*seen)->image.pixels;
      (*seen)->image.pixels = frozen_;
    }
    if (auto said = Say(**seen); !said) return said;
    ++frames_;
    if (options_.lockstep) {
      WaitForAnswer(**seen);
    } else {
      WaitForTick();
    }
  }
  return {};
}

// The fault begins when its time has come.
void VirtualRobot::Fail(steady_clock::time_point now) {
  if (!options_.fault || failed_at_ || !drove_at_) return;
  if (Seconds(now - *drove_at_) < options_.fault->after_s) return;
  failed_at_ = now;
  spdlog::warn("from now on: {}", kFaultNames[static_cast<std::size_t>(options_.fault->kind)].name);
}

Result<void> VirtualRobot::Say(const Observation& seen) {
  // Odometry first: it is there when the frame comes.
  if (seen.odometry && !failed(Kind::kOdometryStops)) {
    if (auto said = link_.Publish(dds::Ros2Odometry{seen.stamp, *seen.odometry}); !said)
      return said;
  }
  if (failed(Kind::kCameraStops)) return {};
  return link_.Publish(ToRos2(seen));
}

void VirtualRobot::WaitForAnswer(const Observation& seen) {
  auto said_at = steady_clock::now();
  while (!options_.stop()) {
    if (const auto command = link_.Take(kListen)) {
      Hear(*command);
      if (command->stamp == seen.stamp) return;
    }
    const auto now = steady_clock::now();
    if (now - said_at < kSayAgain) continue;
    said_at = now;
    if (!link_.watched()) continue;
    ++said_again_;
    if (auto said = Say(seen); !said) spdlog::warn("{}", said.error().message);
  }
}

void VirtualRobot::WaitForTick() {
  const auto period = std::chrono::duration_cast<steady_clock::duration>(
      std::chrono::duration<double>(1.0 / options_.rate_hz));
  next_tick_ = std::max(next_tick_ + period, steady_clock::now());
  while (true) {
    const auto left = std::chrono::ceil<milliseconds>(next_tick_ - steady_clock::now());
    if (left <= milliseconds(0)) break;
    if (const auto command = link_.Take(std::min(left, kListen))) Hear(*command);
  }
  if (const auto command = link_.Take(milliseconds(0))) Hear(*command);
}

void VirtualRobot::Hear(const dds::Ros2Command& command) {
  const auto now = steady_clock::now();
  command_ = command.velocity;
  told_at_ = now;
  ++commands_;
  const bool stand = command_ == motion::VelocityCommand{};
  if (!stand && !drove_at_) drove_at_ = now;
  if (stand && failed_at_ && !told_to_stand_at_) told_to_stand_at_ = now;
}

Summary VirtualRobot::Tell() const {
  Summary summary;
  summary.Add("frames", std::to_string(frames_));
  summary.Add("commands", std::to_string(commands_));
  summary.Add("said_again", std::to_string(said_again_));
  if (failed_at_) {
    summary.Add("told_to_stand_after_s",
                told_to_stand_at_ ? fmt::format("{:.3f}", Seconds(*told_to_stand_at_ - *failed_at_))
                                  : "never");
  }
  return summary;
}

}  // namespace

Result<RobotFault> ParseRobotFault(const std::string& text) {
  const std::size_t at = text.find('@');
  const std::string_view word = std::string_view(text).substr(0, at);
  for (const FaultName& fault : kFaultNames) {
    if (fault.name != word || at == std::string::npos) continue;
    double after_s = 0.0;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data() + at + 1, end, after_s);
    if (error == std::errc{} && next == end && after_s >= 0.0) {
      return RobotFault{fault.kind, after_s};
    }
  }
  return trailcast::Fail(ErrorCode::kInvalidArgument,
                         "'{}' is no fault: expected camera-freezes@S, camera-stops@S, "
                         "odometry-stops@S or base-stops@S, S seconds after the robot was first "
                         "told to drive",
                         text);
}

Result<Summary> RunVirtualRobot(SimulatedDevice& robot, const VirtualRobotOptions& options) {
  auto link = dds::Ros2Robot::Open(options.topics);
  if (!link) return Wrap(link.error(), "the robot's topics");
  spdlog::info("robot {}: {} on {}, {}", options.topics.robot, robot.camera(),
               options.topics.ImageTopic(),
               options.lockstep ? "in lockstep with its agent" : "in real time");
  VirtualRobot body(robot, **link, options);
  if (auto ran = body.Run(); !ran) return tl::unexpected(ran.error());
  return body.Tell();
}

}  // namespace trailcast::agent
