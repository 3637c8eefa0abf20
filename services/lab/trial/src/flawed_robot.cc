#include "services/lab/trial/src/flawed_robot.h"

#include <utility>

namespace trailcast::trial {
namespace {

// A ROS 2 robot's device waits in the same way, because odometry of a picture's moment may come a
// little later.
constexpr std::chrono::milliseconds kOdometryLate{60};
constexpr std::chrono::seconds kSilence{20};

}  // namespace

FlawedRobot::FlawedRobot(sim::SimulatedRobot& robot, const RobotFlaws& flaws, std::uint64_t seed)
    : robot_(robot), electronics_(flaws.timing, flaws.faults, seed), poses_({}) {}

void FlawedRobot::StepBase(const OnStep& on_step) {
  for (const std::string& name : electronics_.Advance(now_)) news_.push_back(name);
  robot_.SetGrip(electronics_.grip(), 1.0);
  const motion::VelocityCommand obeyed = electronics_.Obey(now_);
  sim::Observation seen =
      electronics_.TakesPicture() ? robot_.Step(obeyed) : robot_.StepBlind(obeyed);
  now_ = Time(seen.stamp);
  on_step(seen.stamp);
  if (const auto said = electronics_.Say(seen.stamp, seen.odometry)) {
    poses_.AddOdometry(said->stamp, said->pose, now_, told_);
  }
  if (!seen.image.empty()) electronics_.Take(now_, {seen.stamp, std::move(seen.image)});
}

// An agent takes the newest one.
void FlawedRobot::HearPictures() {
  while (auto picture = electronics_.Due(now_)) {
    const auto taken = poses_.AddFrame(picture->stamp, now_);
    if (!taken) continue;
    if (!newest_) unserved_since_ = now_;
    newest_ = Frame{*taken, std::move(picture->image)};
  }
}

bool FlawedRobot::ready() const {
  if (!newest_ || !poses_.has_odometry()) return false;
  return poses_.Reaches(newest_->taken) || now_ - unserved_since_ > kOdometryLate;
}

std::optional<agent::Observation> FlawedRobot::Next(const motion::VelocityCommand& command,
                                                    const OnStep& on_step) {
  told_ = command;
  electronics_.Hear(now_, command);
  const Time since = now_;
  do {
    if (now_ - since > kSilence) return std::nullopt;
    StepBase(on_step);
    HearPictures();
  } while (!ready());
  Frame frame = *std::exchange(newest_, std::nullopt);
  agent::Observation observation;
  observation.stamp = frame.taken;
  observation.image = std::move(frame.image);
  observation.odometry = poses_.At(frame.taken);
  observation.unknown = poses_.TakeUnknown();
  return observation;
}

std::vector<std::string> FlawedRobot::TakeNews() {
  for (std::string& line : poses_.TakeNews()) news_.push_back(std::move(line));
  return std::exchange(news_, {});
}

}  // namespace trailcast::trial
