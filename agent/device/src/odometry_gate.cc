#include "agent/device/odometry_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

// These allow for the noise of odometry and of its stamps.
constexpr double kSlack_m = 0.05;
constexpr double kSlack_rad = 0.1;
// After a longer silence of its odometry, a driving base has been stopped.
constexpr double kLongestGap_s = 1.0;

}  // namespace

bool OdometryGate::Jumps(double seconds, const motion::Pose2& moved) const {
  const double driving_s = std::min(seconds, options_.longest_silence_s);
  return motion::Position(moved).norm() > kSlack_m + driving_s * options_.speed_mps ||
         std::abs(moved.heading_rad) > kSlack_rad + driving_s * options_.turn_rate_radps;
}

motion::OdometryIncrement OdometryGate::Unknown(double gap_s,
                                                const motion::VelocityCommand& told) const {
  const double seconds = std::min(gap_s, kLongestGap_s);
  return {seconds * std::max(std::abs(told.linear_mps), std::abs(speed_.distance_m)),
          seconds * std::max(std::abs(told.angular_radps), std::abs(speed_.heading_change_rad))};
}

OdometryGate::Passed OdometryGate::Pass(SensorTime taken, const motion::Pose2& pose,
                                        const motion::VelocityCommand& told) {
  Passed passed{pose, std::nullopt};
  if (last_) {
    const motion::Pose2 moved = motion::Between(last_->raw, pose);
    const auto gap = taken - last_->taken;
    if (Jumps(Seconds(gap), moved)) {
      passed = {last_->passed,
                OdometryJump{gap, motion::Position(moved).norm(), Unknown(Seconds(gap), told)}};
    } else {
      passed.pose = motion::Compose(last_->passed, moved);
      const auto driven = motion::IncrementBetween(last_->passed, passed.pose);
      speed_ = {driven.distance_m / Seconds(gap), driven.heading_change_rad / Seconds(gap)};
    }
  }
  last_ = Sample{taken, pose, passed.pose};
  return passed;
}

std::string OdometryJump::Text() const {
  return fmt::format(
      "odometry jumped by {:.2f} m in {:.2f} s, which no base drives: it goes on from where it "
      "was, and vision tells the rest",
      distance_m, Seconds(gap));
}

}  // namespace trailcast::agent
