#pragma once

#include <Eigen/Core>
#include <limits>

namespace trailcast::trial {

// Notices a robot that gets nowhere as patiently as its agent does: it has not come 0.2 m further
// for so long.
class StandstillWatch {
 public:
  static constexpr double kBound_s = 60.0;
  static constexpr double kDistance_m = 0.2;

  // Takes the robot's true position, at rising times.
  [[nodiscard]] bool Stuck(const Eigen::Vector2d& position_m, double time_s) {
    if ((position_m - anchor_m_).norm() > kDistance_m) {
      anchor_m_ = position_m;
      since_s_ = time_s;
    }
    return time_s - since_s_ > kBound_s;
  }

 private:
  // It is far from the first position, which therefore replaces it.
  Eigen::Vector2d anchor_m_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  double since_s_ = 0.0;
};

}  // namespace trailcast::trial
