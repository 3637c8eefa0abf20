#include "agent/device/src/robot_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::agent {
namespace {

// Below these a base may stand because of friction and dead bands.
constexpr double kLeastDrive_mps = 0.05;
constexpr double kLeastTurn_radps = 0.15;
// A base takes this long to start from a stand, where it does no harm.
constexpr std::chrono::milliseconds kToGetGoing{1000};
// A base that drives a smaller share of what was commanded did not obey.
constexpr double kLeastShare = 0.1;
// Weaving adds up to less than this, and so shows nothing.
constexpr double kLeastAsked_m = 0.01;
// A picture without noise may be the same after less motion.
constexpr double kLeastSeen_m = 0.01;
// A base that stands rests for so long before it is tried again, each time twice as long.
constexpr std::chrono::milliseconds kFirstRest{1000};
constexpr std::chrono::milliseconds kLongestRest{4000};
// Half a small robot's width converts turns to distances.
constexpr double kArm_m = 0.15;

bool Drives(const motion::VelocityCommand& command) {
  return std::abs(command.linear_mps) >= kLeastDrive_mps ||
         std::abs(command.angular_radps) >= kLeastTurn_radps;
}

bool Stands(const motion::VelocityCommand& command) { return command == motion::VelocityCommand{}; }

double Way(const motion::Pose2& from, const motion::Pose2& to) {
  return (motion::Position(to) - motion::Position(from)).norm() +
         kArm_m * std::abs(WrapAngle(to.heading_rad - from.heading_rad));
}

}  // namespace

void RobotWatch::SawFrame(Time now, bool changed) {
  frame_at_ = now;
  if (changed) frozen_ = false;
  // A standing robot's picture may well stay the same.
  const bool anew = changed || Stands(told_);
  if (anew) anew_from_ = pose_;
  if (anew || StandsYet()) anew_at_ = now;
}

// A base may take its time. Without odometry it is taken to obey.
bool RobotWatch::StandsYet() const {
  return has_odometry_ && Way(anew_from_, pose_) < kLeastSeen_m;
}

void RobotWatch::SawOdometry(Time now, SensorTime stamp, const motion::Pose2& pose) {
  odometry_at_ = now;
  pose_ = pose;
  if (!Drives(told_)) return;
  driven_.push_back({stamp, pose, told_});
  JudgeBase(now);
}

void RobotWatch::Told(const motion::VelocityCommand& command) {
  told_ = command;
  if (Drives(command)) return;
  driven_.clear();
  obeyed_ = false;
}

// Compares the commanded and the driven distance over the last while of driving.
void RobotWatch::JudgeBase(Time now) {
  const auto span = obeyed_ ? timeout_ : std::max(timeout_, kToGetGoing);
  while (driven_.size() > 2 && driven_.back().stamp - driven_[1].stamp >= span) {
    driven_.pop_front();
  }
  const Sample& first = driven_.front();
  const Sample& last = driven_.back();
  if (last.stamp - first.stamp < span) return;
  motion::Pose2 asked;
  for (std::size_t i = 1; i < driven_.size(); ++i) {
    const motion::VelocityCommand& told = driven_[i - 1].told;
    const double seconds = Seconds(driven_[i].stamp - driven_[i - 1].stamp);
    asked = motion::Advance(asked, {told.linear_mps * seconds, told.angular_radps * seconds});
  }
  const double asked_m = Way({}, asked);
  if (asked_m < kLeastAsked_m) return;
  if (Way(first.pose, last.pose) < kLeastShare * asked_m) {
    NoteStand(now);
  } else {
    obeyed_ = true;
    stand_.reset();
  }
}

void RobotWatch::NoteStand(Time now) {
  if (!stand_) {
    stand_ = Stand{now, now, kFirstRest};
  } else {
    stand_->rest = std::min(2 * stand_->rest, kLongestRest);
  }
  stand_->try_at = now + stand_->rest;
  driven_.clear();
  obeyed_ = false;
}

std::optional<RobotWatch::Trouble> RobotWatch::Check(Time now) {
  if (!frame_at_) return std::nullopt;
  if (auto camera = CheckCamera(now)) return camera;
  if (auto odometry = CheckOdometry(now)) return odometry;
  if (auto scan = CheckScan(now)) return scan;
  if (auto range = CheckRanges(now)) return range;
  return CheckBase(now);
}

std::optional<RobotWatch::Trouble> RobotWatch::CheckCamera(Time now) {
  using Part = Trouble::Part;
  if (now - *frame_at_ > timeout_) {
    return Trouble{Part::kCamera, fmt::format("no picture for {:.1f} s", Seconds(timeout_))};
  }
  if (!Stands(told_) && now - anew_at_ > timeout_) frozen_ = true;
  if (frozen_) {
    return Trouble{Part::kCamera, fmt::format("the same picture again and again for {:.1f} s, told "
                                              "to drive: it is frozen, or the robot does not move",
                                              Seconds(timeout_))};
  }
  return std::nullopt;
}

std::optional<RobotWatch::Trouble> RobotWatch::CheckOdometry(Time now) const {
  if (!has_odometry_ || !odometry_at_ || now - *odometry_at_ <= timeout_) return std::nullopt;
  return Trouble{Trouble::Part::kOdometry,
                 fmt::format("no odometry for {:.1f} s", Seconds(timeout_))};
}

std::optional<RobotWatch::Trouble> RobotWatch::CheckScan(Time now) const {
  if (!has_scan_ || !scan_at_ || now - *scan_at_ <= timeout_) return std::nullopt;
  return Trouble{Trouble::Part::kScan, fmt::format("no scan for {:.1f} s", Seconds(timeout_))};
}

std::optional<RobotWatch::Trouble> RobotWatch::CheckRanges(Time now) const {
  for (std::size_t i = 0; i < range_at_.size(); ++i) {
    if (!range_at_[i] || now - *range_at_[i] <= timeout_) continue;
    return Trouble{Trouble::Part::kRange, fmt::format("no range for {:.1f} s", Seconds(timeout_)),
                   i};
  }
  return std::nullopt;
}

std::optional<RobotWatch::Trouble> RobotWatch::CheckBase(Time now) const {
  if (!stand_ || now >= stand_->try_at) return std::nullopt;
  return Trouble{Trouble::Part::kBase,
                 "told to drive, and by its odometry it stands: blocked, switched off, or held by "
                 "a safety or emergency stop; it is tried again, gently"};
}

}  // namespace trailcast::agent
