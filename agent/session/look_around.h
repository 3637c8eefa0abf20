#pragma once

#include <cstddef>
#include <vector>

namespace trailcast::agent {

// How far to either side a robot looks around unless told otherwise: a wheel that spins for a
// second turns a small robot by a right angle.
constexpr double kUsualLookAround_deg = 120.0;

// Turns a robot that has lost its path from view on the spot: to the left and to the right, first
// nearer by, and back to where it faced. Once, until it has seen its path again. No clock: the
// frames' own periods count.
class LookingAround {
 public:
  // 0: it never does.
  explicit LookingAround(double furthest_rad);

  // The path is in view.
  void Rest();
  // It is not: the robot, that turned so far to the left since the last frame, is to turn on.
  // False: it has looked everywhere.
  [[nodiscard]] bool Turn(double turned_rad, double dt_s);

  [[nodiscard]] bool turns() const { return begun_ && leg_ < aims_rad_.size(); }
  [[nodiscard]] double turn_rate_radps() const;  // to the left; 0: it does not turn
  [[nodiscard]] double furthest_rad() const { return furthest_rad_; }

 private:
  [[nodiscard]] double Left_rad() const { return aims_rad_[leg_] - heading_rad_; }

  double furthest_rad_;
  std::vector<double> aims_rad_;  // one after the other
  bool begun_ = false;
  double heading_rad_ = 0.0;  // to the left of where it began
  std::size_t leg_ = 0;
  double leg_s_ = 0.0;
};

}  // namespace trailcast::agent
