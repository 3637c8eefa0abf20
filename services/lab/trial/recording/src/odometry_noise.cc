#include "services/lab/trial/recording/odometry_noise.h"

#include <array>
#include <random>
#include <utility>

#include "services/base/angles.h"
#include "services/lab/trial/recording/src/named_changes.h"

namespace trailcast::trial {
namespace {

using KnownFault = NamedChange<OdometryFault>;

constexpr std::array kKnownFaults{
    KnownFault{OdometryFault::kScale, "scale", 1.1, 0.0, 10.0, "each metre counts as so many"},
    KnownFault{OdometryFault::kTurn, "turn", 1.2, -10.0, 10.0, "each turn counts as so many"},
    KnownFault{OdometryFault::kDrift, "drift", 3.0, -90.0, 90.0,
               "turns by so many degrees a metre that nobody drives"},
    KnownFault{OdometryFault::kBias, "bias", 0.1, -10.0, 10.0,
               "a gyro's bias: turns by so many radians a second that nobody drives"},
    KnownFault{OdometryFault::kDelay, "delay", 0.2, 0.0, 10.0,
               "tells what was so many seconds ago"},
    KnownFault{OdometryFault::kSlips, "slips", 1.0, 0.0, 60.0, "a wheel spins for so many seconds"},
    KnownFault{OdometryFault::kFrozen, "frozen", 2.0, 0.0, 60.0,
               "tells of no motion for so many seconds"},
    KnownFault{OdometryFault::kJumps, "jumps", 2.0, 1.0, 100.0,
               "is 2 m further and turned by 1 radian all at once, so many times"}};

constexpr double kEarliest = 0.25;  // share of the drive
constexpr double kLatest = 0.65;
// The false motion of a spinning wheel.
constexpr motion::VelocityCommand kSpins{0.4, 0.8};
constexpr motion::OdometryIncrement kJump{2.0, 1.0};

double Share(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1.0p-53; }

}  // namespace

Result<OdometryNoise> ParseOdometryNoise(const std::string& text) {
  return ParseNamedChanges<OdometryChange>(text, kKnownFaults, "fault of odometry");
}

std::string OdometryNoiseHelp() { return HelpOf(kKnownFaults); }

OdometrySpoiler::OdometrySpoiler(OdometryNoise noise, double drive_s, std::uint64_t seed)
    : noise_(std::move(noise)) {
  std::mt19937_64 random(seed);
  for (const OdometryChange& change : noise_) {
    const bool often = change.fault == OdometryFault::kJumps;
    std::vector<double>& moments_s = moments_s_.emplace_back();
    const int count = often ? static_cast<int>(change.value) : 1;
    for (int i = 0; i < count; ++i) {
      moments_s.push_back(drive_s * (kEarliest + (kLatest - kEarliest) * Share(random)));
    }
    if (change.fault == OdometryFault::kDelay) delay_s_ += change.value;
  }
}

motion::OdometryIncrement OdometrySpoiler::Spoil(motion::OdometryIncrement moved, double now_s,
                                                 double dt_s) const {
  const double driven_m = moved.distance_m;
  for (std::size_t i = 0; i < noise_.size(); ++i) {
    const auto [fault, value] = noise_[i];
    const double since_s = now_s - moments_s_[i].front();
    const bool lasts = since_s >= 0.0 && since_s < value;
    switch (fault) {
      case OdometryFault::kScale:
        moved.distance_m *= value;
        break;
      case OdometryFault::kTurn:
        moved.heading_change_rad *= value;
        break;
      case OdometryFault::kDrift:
        moved.heading_change_rad += driven_m * Radians(value);
        break;
      case OdometryFault::kBias:
        moved.heading_change_rad += value * dt_s;
        break;
      case OdometryFault::kSlips:
        if (!lasts) break;
        moved.distance_m += kSpins.linear_mps * dt_s;
        moved.heading_change_rad += kSpins.angular_radps * dt_s;
        break;
      case OdometryFault::kFrozen:
        if (lasts) moved = {};
        break;
      case OdometryFault::kJumps:
        for (const double moment_s : moments_s_[i]) {
          if (now_s < moment_s || now_s - dt_s >= moment_s) continue;
          moved.distance_m += kJump.distance_m;
          moved.heading_change_rad += kJump.heading_change_rad;
        }
        break;
      case OdometryFault::kDelay:
        break;
    }
  }
  return moved;
}

motion::Pose2 OdometrySpoiler::Tell(SensorTime stamp, const motion::Pose2& pose) {
  if (noise_.empty()) return pose;
  if (!std::exchange(begun_, true)) {
    first_ = stamp;
    told_ = last_ = pose;
    waiting_.push_back({stamp, told_});
  }
  const double dt_s = Seconds(stamp - waiting_.back().stamp);
  const motion::OdometryIncrement moved =
      motion::IncrementBetween(std::exchange(last_, pose), pose);
  told_ = motion::Advance(told_, Spoil(moved, Seconds(stamp - first_), dt_s));
  waiting_.push_back({stamp, told_});
  while (waiting_.size() > 1 && Seconds(stamp - waiting_[1].stamp) >= delay_s_) {
    waiting_.pop_front();
  }
  return waiting_.front().pose;
}

}  // namespace trailcast::trial
