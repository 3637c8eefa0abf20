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

// Makes a robot stand before what its scanner and range sensors see in its way: slows it so that it
// still can, lets it stand with a gap, and go on once its way has been clear for half a second.
// Told of all that comes; reads no clock itself.
class ObstacleWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  ObstacleWatch(const ObstacleOptions& options, bool has_scan);

  void See(Time now, const motion::Scan& scan);
  // By the range sensor of that number in ObstacleOptions.
  void See(Time now, std::size_t sensor, const motion::ConeRange& range);
  [[nodiscard]] bool has_scanned() const { return scan_.has_value(); }
  // What the scanner saw last, seen from the axle: x ahead, y left.
  [[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> scanned() const {
    return scan_ ? std::optional(scan_->points) : std::nullopt;
  }
  // The first range sensor of which nothing came yet.
  [[nodiscard]] std::optional<std::size_t> silent_range() const;
  // Something came of each of them.
  [[nodiscard]] bool has_seen_all() const {
    return (!has_scan_ || has_scanned()) && !silent_range();
  }
  // The newest of each of them is of that time, or later.
  [[nodiscard]] bool Reaches(Time time) const;

  // What the robot is to do, by whoever drives it; returns what may be done of it by the newest
  // looks: the same bend, slower, or nothing, for which the robot then waits; asked to go another
  // way meanwhile, which is free, it goes at once. Backwards, where none of them looks, no faster
  // than kUnseen_mps.
  [[nodiscard]] motion::VelocityCommand Want(const motion::VelocityCommand& wanted);
  static constexpr double kUnseen_mps = 0.15;
  // It is to drive backwards, and none of them looks there.
  [[nodiscard]] bool backs_unseen() const { return wanted_.linear_mps < 0.0 && !looks_back_; }
  // What it waits for, one line for people, the same until it goes on; nothing: it may drive.
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
  std::optional<Look> scan_;  // the newest; nothing: there was none yet
  std::vector<std::optional<Look>> ranges_;
  std::vector<Eigen::Vector2d> points_;  // of them all
  motion::VelocityCommand wanted_;
  motion::VelocityCommand stopped_;  // the way on which it met what it waits for
  std::optional<std::string> waits_;
  std::optional<Time> clear_since_;
};

}  // namespace trailcast::agent
