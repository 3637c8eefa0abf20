#include "services/lab/simulated/robot_electronics.h"

#include <utility>

namespace trailcast::agent {
namespace {

using Kind = RobotFault::Kind;

constexpr std::chrono::milliseconds kCommandLife{500};
constexpr std::chrono::seconds kClockBack{5};
const motion::Pose2 kJump{1.6, -1.2, 0.5};
constexpr double kSlippingGrip = 0.3;

}  // namespace

RobotElectronics::RobotElectronics(const RobotTiming& timing, const std::vector<RobotFault>& faults,
                                   std::uint64_t seed)
    : timing_(timing), faults_(faults), drops_(seed, "dropped pictures") {}

void RobotElectronics::Hear(Time now, const motion::VelocityCommand& command) {
  heard_.push_back({now, command});
  if (command != motion::VelocityCommand{}) faults_.DroveAt(now);
}

std::vector<std::string> RobotElectronics::Advance(Time now) {
  std::vector<std::string> begun = faults_.Advance(now);
  for (const std::string& name : begun) {
    if (name == "odometry-restarts") odometry_from_ = odometry_.value_or(motion::Pose2{});
    if (name == "odometry-jumps") odometry_from_ = motion::Compose(odometry_from_, kJump);
    if (name == "odometry-clock-back") odometry_back_ += kClockBack;
    if (name == "camera-clock-back") pictures_back_ += kClockBack;
  }
  return begun;
}

motion::VelocityCommand RobotElectronics::Obey(Time now) {
  const auto delay = FromSeconds(timing_.base_delay_s);
  while (heard_.size() > 1 && now - heard_[1].at >= delay) heard_.pop_front();
  if (heard_.empty() || faults_.active(Kind::kBaseStops)) return {};
  const auto age = now - heard_.front().at;
  return age >= delay && age <= kCommandLife + delay ? heard_.front().command
                                                     : motion::VelocityCommand{};
}

double RobotElectronics::grip() const {
  return faults_.active(Kind::kWheelSlips) ? kSlippingGrip : 1.0;
}

bool RobotElectronics::TakesPicture() {
  pictures_due_ += timing_.picture_rate_hz / timing_.rate_hz;
  if (pictures_due_ < 1.0) return false;
  pictures_due_ -= 1.0;
  return drops_.Uniform(0.0, 1.0) >= timing_.dropped;
}

std::optional<RobotElectronics::Odometry> RobotElectronics::Say(SensorTime stamp,
                                                                const motion::Pose2& pose) {
  odometry_ = pose;
  if (faults_.active(Kind::kOdometryStops)) return std::nullopt;
  return Odometry{stamp - odometry_back_, motion::Between(odometry_from_, pose)};
}

void RobotElectronics::Take(Time now, Picture picture) {
  if (faults_.active(Kind::kCameraStops)) return;
  picture.stamp += FromSeconds(timing_.stamps_late_s) - pictures_back_;
  if (faults_.active(Kind::kCameraStampsStand)) {
    if (!stands_at_) stands_at_ = picture.stamp;
    picture.stamp = *stands_at_;
  }
  if (faults_.active(Kind::kCameraFreezes)) {
    if (!frozen_) frozen_ = picture.image;
    picture.image = *frozen_;
  }
  taken_.push_back({now, std::move(picture)});
}

std::optional<RobotElectronics::Picture> RobotElectronics::Due(Time now) {
  if (taken_.empty() || now - taken_.front().at < FromSeconds(timing_.picture_delay_s)) {
    return std::nullopt;
  }
  Picture picture = std::move(taken_.front().picture);
  taken_.pop_front();
  return picture;
}

}  // namespace trailcast::agent
