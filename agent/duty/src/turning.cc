#include "agent/duty/src/turning.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::agent {
namespace {

// The bound keeps a robot with late frames from turning much too far.
constexpr double kMost_radps = 0.5;
constexpr double kLeast_radps = 0.1;
constexpr double kPerSecond = 1.0;  // of the rest
constexpr double kThere_rad = 0.03;
constexpr double kMoves_rad = 1e-3;  // in a frame
constexpr std::chrono::seconds kPatience{30};

}  // namespace

Result<bool> Turning::TurnOnTo(double to_rad) {
  const auto seen = device_.Next();
  if (!seen) return tl::unexpected(seen.error());
  if (!*seen) return Fail(ErrorCode::kUnavailable, "the recording ends");
  const Observation& now = **seen;
  if (!now.odometry) {
    return Fail(ErrorCode::kUnavailable,
                "it is to turn on the spot, and has no odometry to turn by");
  }
  const double on_rad = pose_ ? WrapAngle(now.odometry->heading_rad - pose_->heading_rad) : 0.0;
  pose_ = now.odometry;
  turned_rad_ += on_rad;
  if (!moved_at_ || std::abs(on_rad) > kMoves_rad) moved_at_ = now.stamp;
  const double left_rad = to_rad - turned_rad_;
  if (std::abs(left_rad) <= kThere_rad) {
    standstill_.Stop();
    return true;
  }
  if (now.stamp - *moved_at_ > kPatience) {
    return Fail(ErrorCode::kUnavailable,
                "it is to turn on the spot by {:.0f} degrees more, and has not moved for {} s: is "
                "there something in its way?",
                Degrees(std::abs(left_rad)), kPatience.count());
  }
  const double rate_radps = std::clamp(kPerSecond * std::abs(left_rad), kLeast_radps, kMost_radps);
  if (auto driven = device_.Drive({0.0, std::copysign(rate_radps, left_rad)}); !driven) {
    return tl::unexpected(driven.error());
  }
  return false;
}

}  // namespace trailcast::agent
