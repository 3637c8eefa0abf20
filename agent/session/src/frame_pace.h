#pragma once

#include <deque>

#include "services/motion/motion.h"

namespace trailcast::agent {

struct FramePaceOptions {
  // Of the way and the turn between two pictures: beyond, features pass through the picture faster
  // than they can be followed and judged.
  double furthest_m = 0.15;
  double furthest_turn_rad = 0.1;
};

// A robot whose camera sees seldom, or loses pictures, drives slower, by the same way.
class FramePace {
 public:
  explicit FramePace(const FramePaceOptions& options = {}) : options_(options) {}

  // A picture came so long after the one before.
  void Note(double after_s);
  // The command, slowed down where it has to be.
  [[nodiscard]] motion::VelocityCommand Within(const motion::VelocityCommand& wanted) const;

 private:
  FramePaceOptions options_;
  std::deque<double> lately_s_;
};

}  // namespace trailcast::agent
