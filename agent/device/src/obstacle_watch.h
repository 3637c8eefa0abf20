#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/obstacle_options.h"
#include "services/motion/free_way.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Makes a robot stand before what its scanner sees in its way: slows it so that it still can, lets
// it stand with a gap, and go on once its way has been clear for half a second. Told of all that
// comes; reads no clock itself.
class ObstacleWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit ObstacleWatch(const ObstacleOptions& options);

  void See(Time now, const motion::Scan& scan);
  [[nodiscard]] bool has_seen() const { return seen_; }

  // What the robot is to do, by whoever drives it; returns what may be done of it by the newest
  // scan: the same bend, slower, or nothing, for which the robot then waits.
  [[nodiscard]] motion::VelocityCommand Want(const motion::VelocityCommand& command);
  // What it waits for, one line for people, the same until it goes on; nothing: it may drive.
  [[nodiscard]] const std::optional<std::string>& waits() const { return waits_; }

 private:
  [[nodiscard]] bool Clear() const;
  [[nodiscard]] motion::VelocityCommand Slowed(const motion::VelocityCommand& command,
                                               double way_m) const;
  [[nodiscard]] std::string Text(const motion::InTheWay& met) const;

  ObstacleOptions options_;
  motion::Outline outline_;
  bool seen_ = false;
  std::vector<Eigen::Vector2d> points_;  // of the newest scan
  motion::VelocityCommand wanted_;
  std::optional<std::string> waits_;
  std::optional<Time> clear_since_;
};

}  // namespace trailcast::agent
