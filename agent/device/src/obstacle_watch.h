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

  // What may be done of `command` by the newest scan: the same bend, slower, or nothing.
  [[nodiscard]] motion::VelocityCommand Within(const motion::VelocityCommand& command) const;
  // What the robot is to do, by whoever drives it. It waits if nothing of that may be done.
  void Want(const motion::VelocityCommand& command);
  // What it waits for, one line for people, the same until it goes on; nothing: it may drive.
  [[nodiscard]] const std::optional<std::string>& waits() const { return waits_; }

 private:
  [[nodiscard]] std::optional<motion::InTheWay> Met(const motion::VelocityCommand& command) const;
  [[nodiscard]] bool Clear() const;
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
