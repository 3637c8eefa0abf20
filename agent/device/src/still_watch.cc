#include "agent/device/src/still_watch.h"

#include <cmath>

namespace trailcast::agent {
namespace {

// Smaller motions are the noise of odometry.
constexpr double kStill_m = 0.02;
constexpr double kStill_rad = 0.02;

bool Moved(const motion::Pose2& from, const motion::Pose2& to) {
  const motion::Pose2 step = motion::Between(from, to);
  return motion::Position(step).norm() > kStill_m || std::abs(step.heading_rad) > kStill_rad;
}

}  // namespace

bool StillWatch::Over(SensorTime stamp, const motion::Pose2& pose) {
  if (!place_ || Moved(*place_, pose)) {
    moved_ = place_.has_value();
    place_ = pose;
    since_ = stamp;
  }
  return limit_ > std::chrono::milliseconds(0) && moved_ && stamp - since_ >= limit_;
}

}  // namespace trailcast::agent
