#include "agent/session/src/kept_drive.h"

#include <cmath>
#include <utility>

namespace trailcast::agent {
namespace {

constexpr double kEach_s = 0.095;  // ten a second, with a margin for time stamps
// A robot that stands while its scout prepares teaches nothing.
constexpr double kMoves_m = 1e-3;
constexpr double kMoves_rad = 1e-3;

bool Stands(const Observation& before, const Observation& now) {
  if (!before.odometry || !now.odometry) return false;
  const motion::Pose2 moved = motion::Between(*before.odometry, *now.odometry);
  return motion::Position(moved).norm() < kMoves_m && std::abs(moved.heading_rad) < kMoves_rad;
}

}  // namespace

void KeptDrive::Add(int number, Observation seen) {
  if (!whole_) return;
  if (!frames_.empty() && Stands(frames_.back().seen, seen)) return imu_.clear();
  imu_.insert(imu_.end(), seen.imu.begin(), seen.imu.end());
  if (!frames_.empty() && Seconds(seen.stamp - frames_.back().seen.stamp) < kEach_s) return;
  seen.imu = std::exchange(imu_, {});
  bytes_ += seen.image.pixels.size() + seen.imu.size() * sizeof(motion::ImuSample);
  frames_.push_back({number, std::move(seen)});
  if (bytes_ <= most_bytes_) return;
  whole_ = false;
  frames_ = {};
}

}  // namespace trailcast::agent
