#pragma once

#include "services/motion/motion.h"

namespace trailcast::teach {

struct SpotTurnOptions {
  double largest_radius_m = 0.1;  // of the arc: a smaller one is a turn on the spot
  double least_rad = 0.2;         // turned so, before it counts as one
  double driven_m = 0.01;         // without such an arc: the turn is over
};

// Tells a robot that turns on the spot from one that drives, by its odometry.
class SpotTurnWatch {
 public:
  enum class State {
    kDrives,
    kMayTurn,  // it has begun to, too little to say
    kTurns,
  };

  explicit SpotTurnWatch(const SpotTurnOptions& options = {}) : options_(options) {}

  State Add(const motion::OdometryIncrement& step);
  [[nodiscard]] State state() const { return state_; }
  // Since it may have begun to turn; counter-clockwise positive.
  [[nodiscard]] double turned_rad() const { return turned_rad_; }

 private:
  SpotTurnOptions options_;
  State state_ = State::kDrives;
  double turned_rad_ = 0.0;
  double driven_m_ = 0.0;  // since the last arc on the spot
};

}  // namespace trailcast::teach
