#include "services/lab/simulated/virtual_robot.h"

#include <spdlog/spdlog.h>

#include <limits>
#include <optional>
#include <utility>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kListen{20};
// In lockstep, a frame without an answer is sent again.
constexpr milliseconds kSayAgain{500};
constexpr std::chrono::seconds kBatteryEvery{1};
const motion::Pose2 kFront{0.25, 0.0, 0.0};

dds::Ros2Image ToRos2(RobotElectronics::Picture picture) {
  const auto width = static_cast<std::uint32_t>(picture.image.width);
  return {.stamp = picture.stamp,
          .width_px = width,
          .height_px = static_cast<std::uint32_t>(picture.image.height),
          .encoding = "mono8",
          .step = width,
          .data = std::move(picture.image.pixels)};
}

class VirtualRobot {
 public:
  VirtualRobot(SimulatedDevice& robot, dds::Ros2Robot& link, const VirtualRobotOptions& options)
      : robot_(robot),
        link_(link),
        options_(options),
        electronics_(options.timing, options.faults, options.seed) {}

  [[nodiscard]] Result<void> Run();
  [[nodiscard]] Summary Tell() const;

 private:
  [[nodiscard]] Result<std::optional<Observation>> Sense();
  [[nodiscard]] motion::VelocityCommand Obey(steady_clock::time_point now);
  [[nodiscard]] Result<void> Say(const Observation& seen);
  [[nodiscard]] Result<void> SayOdometry(const Observation& seen);
  [[nodiscard]] steady_clock::time_point Now() const;
  [[nodiscard]] std::vector<Pillar> Obstacles() const;
  [[nodiscard]] Result<void> SayWhatStands(SensorTime stamp);
  [[nodiscard]] Result<void> SayImu(const Observation& seen);
  [[nodiscard]] Result<void> SayBattery(const Observation& seen);
  [[nodiscard]] Result<void> SayPictures(const Observation& seen);
  void WaitForAnswer(const Observation& seen);
  void WaitForTick();
  void Hear(const dds::Ros2Command& command);

  SimulatedDevice& robot_;
  dds::Ros2Robot& link_;
  const VirtualRobotOptions& options_;
  RobotElectronics electronics_;
  motion::VelocityCommand answer_;  // for lockstep
  SensorTime seen_at_{0};
  std::optional<SensorTime> battery_said_at_;
  std::optional<steady_clock::time_point> told_to_stand_at_;  // the first stop after a fault
  steady_clock::time_point next_tick_ = steady_clock::now();
  std::size_t frames_ = 0;
  std::size_t said_again_ = 0;
  std::size_t commands_ = 0;
};

Result<void> VirtualRobot::Run() {
  while (!options_.stop()) {
    const auto now = Now();
    for (const std::string& name : electronics_.Advance(now)) spdlog::warn("from now on: {}", name);
    robot_.SetGrip(electronics_.grip(), 1.0);
    if (auto driven = robot_.Drive(Obey(now)); !driven) return driven;
    auto seen = Sense();
    if (!seen) return tl::unexpected(seen.error());
    if (!*seen) return {};
    if (auto said = Say(**seen); !said) return said;
    if (options_.lockstep) {
      WaitForAnswer(**seen);
    } else {
      WaitForTick();
    }
  }
  return {};
}

motion::VelocityCommand VirtualRobot::Obey(steady_clock::time_point now) {
  return options_.lockstep ? answer_ : electronics_.Obey(now);
}

// A camera that is slower than the base has no picture now.
Result<std::optional<Observation>> VirtualRobot::Sense() {
  if (!options_.lockstep && !electronics_.TakesPicture()) return std::optional(robot_.NextBlind());
  ++frames_;
  return robot_.Next();
}

Result<void> VirtualRobot::Say(const Observation& seen) {
  seen_at_ = seen.stamp;
  // The picture comes last, so that the others are there when it arrives.
  if (auto said = SayOdometry(seen); !said) return said;
  if (auto said = SayWhatStands(seen.stamp); !said) return said;
  if (auto said = SayImu(seen); !said) return said;
  if (auto said = SayBattery(seen); !said) return said;
  return SayPictures(seen);
}

Result<void> VirtualRobot::SayOdometry(const Observation& seen) {
  if (!seen.odometry) return {};
  const auto said = electronics_.Say(seen.stamp, *seen.odometry);
  if (!said) return {};
  return link_.Publish(dds::Ros2Odometry{said->stamp, said->pose});
}

// In lockstep, the robot's time passes only by frames.
steady_clock::time_point VirtualRobot::Now() const {
  if (!options_.lockstep) return steady_clock::now();
  return steady_clock::time_point(std::chrono::duration_cast<steady_clock::duration>(seen_at_));
}

std::vector<Pillar> VirtualRobot::Obstacles() const {
  std::vector<Pillar> there;
  const auto driven_s = electronics_.faults().SecondsDriven(Now());
  for (const Pillar& pillar : options_.obstacles) {
    if (driven_s && pillar.spell.contains(*driven_s)) there.push_back(pillar);
  }
  return there;
}

Result<void> VirtualRobot::SayWhatStands(SensorTime stamp) {
  if (link_.scan_is_heard()) {
    if (auto said = link_.Publish(dds::Ros2Scan{stamp, robot_.Scan(Obstacles())}); !said) {
      return said;
    }
  }
  for (std::size_t i = 0; i < options_.range_mounts.size(); ++i) {
    if (!link_.range_is_heard(i)) continue;
    const auto range = robot_.Range(options_.range_mounts[i].value_or(kFront), Obstacles());
    if (auto said = link_.Publish(dds::Ros2Range{stamp, i, range}); !said) return said;
  }
  return {};
}

Result<void> VirtualRobot::SayImu(const Observation& seen) {
  if (seen.imu.empty() || !link_.imu_is_heard()) return {};
  return link_.Publish(dds::Ros2Imu{seen.stamp, seen.imu.back()});
}

Result<void> VirtualRobot::SayBattery(const Observation& seen) {
  constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();
  const auto percent = robot_.battery_percent();
  if (!percent || options_.topics.battery.empty()) return {};
  if (battery_said_at_ && seen.stamp < *battery_said_at_ + kBatteryEvery) return {};
  battery_said_at_ = seen.stamp;
  return link_.Publish(dds::Ros2Battery{seen.stamp, static_cast<float>(*percent) / 100.0F,
                                        kNotMeasured, kNotMeasured});
}

Result<void> VirtualRobot::SayPictures(const Observation& seen) {
  const auto now = Now();
  if (!seen.image.empty()) electronics_.Take(now, {seen.stamp, seen.image});
  while (auto picture = electronics_.Due(now)) {
    if (auto said = link_.Publish(ToRos2(std::move(*picture))); !said) return said;
  }
  return {};
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
      std::chrono::duration<double>(1.0 / options_.timing.rate_hz));
  next_tick_ = std::max(next_tick_ + period, steady_clock::now());
  while (true) {
    const auto left = std::chrono::ceil<milliseconds>(next_tick_ - steady_clock::now());
    if (left <= milliseconds(0)) break;
    if (const auto command = link_.Take(std::min(left, kListen))) Hear(*command);
  }
  if (const auto command = link_.Take(milliseconds(0))) Hear(*command);
}

void VirtualRobot::Hear(const dds::Ros2Command& command) {
  const auto now = Now();
  electronics_.Hear(now, command.velocity);
  answer_ = command.velocity;
  ++commands_;
  const bool stand = command.velocity == motion::VelocityCommand{};
  if (stand && electronics_.faults().first_began_at() && !told_to_stand_at_) {
    told_to_stand_at_ = now;
  }
}

Summary VirtualRobot::Tell() const {
  Summary summary;
  summary.Add("frames", std::to_string(frames_));
  summary.Add("commands", std::to_string(commands_));
  summary.Add("said_again", std::to_string(said_again_));
  if (const auto began = electronics_.faults().first_began_at()) {
    summary.Add(
        "told_to_stand_after_s",
        told_to_stand_at_ ? fmt::format("{:.3f}", Seconds(*told_to_stand_at_ - *began)) : "never");
  }
  return summary;
}

}  // namespace

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
