#include "services/teach/spot_turn.h"

#include <cmath>

namespace trailcast::teach {

SpotTurnWatch::State SpotTurnWatch::Add(const motion::OdometryIncrement& step) {
  const double turned = std::abs(step.heading_change_rad);
  const double driven = std::abs(step.distance_m);
  const bool on_the_spot = turned > 0.0 && driven <= options_.largest_radius_m * turned;
  if (state_ == State::kDrives) {
    if (!on_the_spot) return state_;
    state_ = State::kMayTurn;
    turned_rad_ = 0.0;
  }
  turned_rad_ += step.heading_change_rad;
  driven_m_ = on_the_spot ? 0.0 : driven_m_ + driven;
  if (driven_m_ >= options_.driven_m) {
    state_ = State::kDrives;
    driven_m_ = 0.0;
  } else if (std::abs(turned_rad_) >= options_.least_rad) {
    state_ = State::kTurns;
  }
  return state_;
}

}  // namespace trailcast::teach
