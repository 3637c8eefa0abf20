#include "agent/device/obstacle_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/base/angles.h"

namespace trailcast::agent {
namespace {

// A small base can brake harder, but robots that carry something should not.
constexpr double kDeceleration_mps2 = 0.5;
// The time from a scan until the base obeys: one scan and one command.
constexpr double kReaction_s = 0.3;
// Bases do not creep, so a slower robot stands.
constexpr double kLeast_mps = 0.05;
// The path must be clear so much further than where the robot stopped, because a person does not
// stand still.
constexpr double kFurther_m = 0.1;
constexpr std::chrono::milliseconds kClearFor{500};
// Anything less counts as ahead, not to a side.
constexpr double kAside_m = 0.05;
// A sensor that looks straight back, and so far to either side, covers the path of a reversing
// robot.
constexpr double kBack_rad = std::numbers::pi;
constexpr double kBehind_rad = 0.4;

// Returns the highest speed from which a robot can still brake within the distance, after the
// reaction.
double SpeedWithin(double way_m) {
  if (way_m <= 0.0) return 0.0;
  return kDeceleration_mps2 *
         (std::sqrt(kReaction_s * kReaction_s + 2.0 * way_m / kDeceleration_mps2) - kReaction_s);
}

}  // namespace

ObstacleWatch::ObstacleWatch(const ObstacleOptions& options, bool has_scan)
    : options_(options),
      outline_(OutlineOf(options)),
      has_scan_(has_scan),
      looks_back_(RangeLooksBack()),
      ranges_(options.range_mounts.size()) {}

bool ObstacleWatch::RangeLooksBack() const {
  return std::any_of(options_.range_mounts.begin(), options_.range_mounts.end(),
                     [](const std::optional<motion::Pose2>& mount) {
                       return mount &&
                              std::abs(WrapAngle(mount->heading_rad - kBack_rad)) < kBehind_rad;
                     });
}

void ObstacleWatch::See(Time now, const motion::Scan& scan) {
  scan_ = Look{now, steady_.Next(scan, options_.scan_ahead_m)};
  looks_back_ = RangeLooksBack() || (motion::LooksTo(scan, kBack_rad - kBehind_rad) &&
                                     motion::LooksTo(scan, kBack_rad) &&
                                     motion::LooksTo(scan, kBack_rad + kBehind_rad));
  Note(now);
}

void ObstacleWatch::See(Time now, std::size_t sensor, const motion::ConeRange& range) {
  const motion::Pose2 front{outline_.front_m, 0.0, 0.0};
  ranges_[sensor] = Look{now, motion::Points(range, options_.range_mounts[sensor].value_or(front))};
  Note(now);
}

std::optional<std::size_t> ObstacleWatch::silent_range() const {
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    if (!ranges_[i]) return i;
  }
  return std::nullopt;
}

bool ObstacleWatch::Reaches(Time time) const {
  const auto reaches = [&](const std::optional<Look>& look) { return look && look->at >= time; };
  return (!has_scan_ || reaches(scan_)) && std::all_of(ranges_.begin(), ranges_.end(), reaches);
}

void ObstacleWatch::Note(Time now) {
  points_ = scan_ ? scan_->points : std::vector<Eigen::Vector2d>{};
  for (const std::optional<Look>& look : ranges_) {
    if (look) points_.insert(points_.end(), look->points.begin(), look->points.end());
  }
  if (!waits_) return;
  if (!Clear(wanted_)) {
    clear_since_.reset();
    return;
  }
  if (!clear_since_) clear_since_ = now;
  if (now - *clear_since_ >= kClearFor) waits_.reset();
}

bool ObstacleWatch::Clear(const motion::VelocityCommand& way) const {
  const auto met = motion::FirstMet(points_, outline_, way);
  return !met || met->way_m > options_.gap_m + kFurther_m;
}

// The command must lead away from what still stands there.
bool ObstacleWatch::LeadsAway() const {
  return wanted_ != motion::VelocityCommand{} && Clear(wanted_) && !Clear(stopped_);
}

// Slows the command so that the robot can still stop before an obstacle at that distance.
motion::VelocityCommand ObstacleWatch::Slowed(const motion::VelocityCommand& command,
                                              double way_m) const {
  const double pace_mps = motion::Pace(outline_, command);
  const double most_mps = SpeedWithin(way_m - options_.gap_m);
  if (pace_mps <= most_mps) return command;
  if (most_mps < kLeast_mps) return {};
  const double share = most_mps / pace_mps;
  return {share * command.linear_mps, share * command.angular_radps};
}

motion::VelocityCommand ObstacleWatch::Want(const motion::VelocityCommand& wanted) {
  wanted_ = wanted;
  if (waits_ && LeadsAway()) waits_.reset();
  if (waits_) return {};
  motion::VelocityCommand command = wanted;
  if (backs_unseen() && wanted.linear_mps < -kUnseen_mps) {
    command.angular_radps *= kUnseen_mps / -wanted.linear_mps;
    command.linear_mps = -kUnseen_mps;
  }
  const auto met = motion::FirstMet(points_, outline_, command);
  if (!met) return command;
  const motion::VelocityCommand slowed = Slowed(command, met->way_m);
  if (slowed == motion::VelocityCommand{}) {
    waits_ = Text(*met);
    stopped_ = command;
    clear_since_.reset();
  }
  return slowed;
}

std::string ObstacleWatch::Text(const motion::InTheWay& met) const {
  const Eigen::Vector2d& at = met.at;
  std::string where = at.x() >= 0.0
                          ? fmt::format("{:.1f} m ahead", std::max(0.0, at.x() - outline_.front_m))
                          : fmt::format("{:.1f} m behind its axle", -at.x());
  if (std::abs(at.y()) >= kAside_m) {
    where += fmt::format(", {:.1f} m to the {}", std::abs(at.y()), at.y() > 0.0 ? "left" : "right");
  }
  return fmt::format("something stands {}, in the way: the robot waits", where);
}

}  // namespace trailcast::agent
