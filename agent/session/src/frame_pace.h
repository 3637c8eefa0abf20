#pragma once

#include <deque>

#include "services/motion/motion.h"

namespace trailcast::agent {

struct FramePaceOptions {
  // These limit the distance and the turn between two pictures. Beyond them, features pass through
  // the picture faster than they can be followed and judged.
  double furthest_m = 0.15;
  double furthest_turn_rad = 0.1;
};

// A robot whose camera gives few pictures, or loses some, drives slower along the same path.
class FramePace {
 public:
  explicit FramePace(const FramePaceOptions& options = {}) : options_(options) {}

  // Notes the time between two pictures.
  void Note(double after_s);
  // Returns the command, slowed down if necessary.
  [[nodiscard]] motion::VelocityCommand Within(const motion::VelocityCommand& wanted) const;

 private:
  FramePaceOptions options_;
  std::deque<double> lately_s_;
};

}  // namespace trailcast::agent
