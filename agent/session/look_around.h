#pragma once

#include <cstddef>
#include <vector>

namespace trailcast::agent {

// A robot looks this far to either side by default: a wheel that spins for a second turns a small
// robot by a right angle.
constexpr double kUsualLookAround_deg = 120.0;

// This turns a robot that has lost its path from view on the spot: to the left and to the right,
// first a little, then further, and back to where it faced. It does so once, until the robot has
// seen its path again. It has no clock: the frames' own periods count.
class LookingAround {
 public:
  // With 0 it never turns.
  explicit LookingAround(double furthest_rad);

  // The path is in view.
  void Rest();
  // The path is not in view. The robot, which turned by `turned_rad` to the left since the last
  // frame, should turn on. Returns false if it has looked everywhere.
  [[nodiscard]] bool Turn(double turned_rad, double dt_s);

  [[nodiscard]] bool turns() const { return begun_ && leg_ < aims_rad_.size(); }
  [[nodiscard]] double turn_rate_radps() const;  // to the left; 0 if it does not turn
  [[nodiscard]] double furthest_rad() const { return furthest_rad_; }

 private:
  [[nodiscard]] double Left_rad() const { return aims_rad_[leg_] - heading_rad_; }

  double furthest_rad_;
  std::vector<double> aims_rad_;  // in order
  bool begun_ = false;
  double heading_rad_ = 0.0;  // to the left of where it began
  std::size_t leg_ = 0;
  double leg_s_ = 0.0;
};

}  // namespace trailcast::agent
