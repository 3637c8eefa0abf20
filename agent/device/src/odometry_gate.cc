#include "agent/device/odometry_gate.h"

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

// Of odometry's own noise and its stamps'.
constexpr double kSlack_m = 0.05;
constexpr double kSlack_rad = 0.1;
// A base that is silent is soon told to stand: longer silence does not let it come further.
constexpr double kLongest_s = 0.5;

}  // namespace

bool OdometryGate::Jumps(double seconds, const motion::Pose2& moved) const {
  const double driving_s = std::min(seconds, kLongest_s);
  return motion::Position(moved).norm() > kSlack_m + driving_s * options_.speed_mps ||
         std::abs(moved.heading_rad) > kSlack_rad + driving_s * options_.turn_rate_radps;
}

OdometryGate::Passed OdometryGate::Pass(SensorTime taken, const motion::Pose2& pose) {
  Passed passed{pose, std::nullopt};
  if (last_) {
    const motion::Pose2 moved = motion::Between(last_->raw, pose);
    if (Jumps(Seconds(taken - last_->taken), moved)) {
      passed = {last_->passed, taken - last_->taken, motion::Position(moved).norm()};
    } else {
      passed.pose = motion::Compose(last_->passed, moved);
    }
  }
  last_ = Sample{taken, pose, passed.pose};
  return passed;
}

}  // namespace trailcast::agent
