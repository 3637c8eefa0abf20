#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/obstacle_options.h"
#include "services/motion/cone_range.h"
#include "services/motion/free_way.h"
#include "services/motion/motion.h"
#include "services/motion/steady_points.h"

namespace trailcast::agent {

// Stops a robot before obstacles that its scanner and range sensors see. It slows the robot in
// time, lets it stand with a gap, and lets it go on once its path has been clear for half a second.
// Its caller passes on all samples; it reads no clock itself.
class ObstacleWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  ObstacleWatch(const ObstacleOptions& options, bool has_scan);

  void See(Time now, const motion::Scan& scan);
  // `sensor` is the range sensor's index in ObstacleOptions.
  void See(Time now, std::size_t sensor, const motion::ConeRange& range);
  [[nodiscard]] bool has_scanned() const { return scan_.has_value(); }
  // Returns the last scan's points, seen from the axle: x ahead, y left.
  [[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> scanned() const {
    return scan_ ? std::optional(scan_->points) : std::nullopt;
  }
  // Returns the first range sensor that has given nothing yet.
  [[nodiscard]] std::optional<std::size_t> silent_range() const;
  // Says whether each of them has given something.
  [[nodiscard]] bool has_seen_all() const {
    return (!has_scan_ || has_scanned()) && !silent_range();
  }
  // Says whether the newest sample of each of them is of that time or later.
  [[nodiscard]] bool Reaches(Time time) const;

  // Takes a driver's command and returns the part of it that the newest samples allow: the same
  // bend, slower, or a stop, after which the robot waits. A command for another path that is clear
  // is obeyed at once. Backwards, where no sensor looks, the robot is no faster than kUnseen_mps.
  [[nodiscard]] motion::VelocityCommand Want(const motion::VelocityCommand& wanted);
  static constexpr double kUnseen_mps = 0.15;
  // Says whether it is to reverse and no sensor looks there.
  [[nodiscard]] bool backs_unseen() const { return wanted_.linear_mps < 0.0 && !looks_back_; }
  // Returns what it waits for, as one line for people that stays the same until it goes on, or
  // nothing if it may drive.
  [[nodiscard]] const std::optional<std::string>& waits() const { return waits_; }

 private:
  struct Look {
    Time at;
    std::vector<Eigen::Vector2d> points;
  };
  void Note(Time now);
  [[nodiscard]] bool RangeLooksBack() const;
  [[nodiscard]] bool Clear(const motion::VelocityCommand& way) const;
  [[nodiscard]] bool LeadsAway() const;
  [[nodiscard]] motion::VelocityCommand Slowed(const motion::VelocityCommand& command,
                                               double way_m) const;
  [[nodiscard]] std::string Text(const motion::InTheWay& met) const;

  ObstacleOptions options_;
  motion::Outline outline_;
  bool has_scan_;
  bool looks_back_;
  motion::SteadyPoints steady_;
  std::optional<Look> scan_;  // the newest; nothing if there was none yet
  std::vector<std::optional<Look>> ranges_;
  std::vector<Eigen::Vector2d> points_;  // of all sensors
  motion::VelocityCommand wanted_;
  motion::VelocityCommand stopped_;  // the command with which it met the obstacle
  std::optional<std::string> waits_;
  std::optional<Time> clear_since_;
};

}  // namespace trailcast::agent
