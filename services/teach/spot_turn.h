#pragma once

#include "services/motion/motion.h"

namespace trailcast::teach {

struct SpotTurnOptions {
  double largest_radius_m = 0.1;  // an arc with a smaller one is a turn on the spot
  double least_rad = 0.2;         // turned in such arcs before they count as a turn
  double driven_m = 0.01;         // driven without such an arc, this ends the turn
};

// This tells a robot that turns on the spot from one that drives, by its odometry.
class SpotTurnWatch {
 public:
  enum class State {
    kDrives,
    kMayTurn,  // has begun to, but too little to tell
    kTurns,
  };

  explicit SpotTurnWatch(const SpotTurnOptions& options = {}) : options_(options) {}

  State Add(const motion::OdometryIncrement& step);
  [[nodiscard]] State state() const { return state_; }
  // Returns the turn since it may have begun, counter-clockwise positive.
  [[nodiscard]] double turned_rad() const { return turned_rad_; }

 private:
  SpotTurnOptions options_;
  State state_ = State::kDrives;
  double turned_rad_ = 0.0;
  double driven_m_ = 0.0;  // since the last arc on the spot
};

}  // namespace trailcast::teach
