#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::trial {

// A fault of a robot's odometry.
enum class OdometryFault {
  kScale,   // each metre counts as this many
  kTurn,    // each radian turned counts as this many
  kDrift,   // it turns by so many degrees a metre too much
  kBias,    // it turns by so many radians a second too much, driving or standing: a gyro's bias
  kDelay,   // it is late by so many seconds
  kSlips,   // a wheel spins for so many seconds: a distance and a turn that are not driven
  kFrozen,  // it shows no motion for so many seconds
  kJumps,   // it is suddenly somewhere else, so many times
};

struct OdometryChange {
  OdometryFault fault = OdometryFault::kScale;
  double value = 0.0;  // see above

  bool operator==(const OdometryChange&) const = default;
};

using OdometryNoise = std::vector<OdometryChange>;

// Parses "scale=1.1", "turn=0.8+drift=3" or "slips" (a missing value is the kind's own); "" or
// "none" stand for no fault. The error lists the kinds.
[[nodiscard]] Result<OdometryNoise> ParseOdometryNoise(const std::string& text);

// Returns one line for each kind, for people.
[[nodiscard]] std::string OdometryNoiseHelp();

// Makes odometry wrong, pose by pose.
class OdometrySpoiler {
 public:
  // The robot drives for about `drive_s`; an event at one moment comes between a quarter and two
  // thirds of that, as `seed` draws it.
  OdometrySpoiler(OdometryNoise noise, double drive_s, std::uint64_t seed);

  // Returns the odometry for a pose at that time; times must rise.
  [[nodiscard]] motion::Pose2 Tell(SensorTime stamp, const motion::Pose2& pose);

 private:
  struct Told {
    SensorTime stamp;
    motion::Pose2 pose;
  };
  [[nodiscard]] motion::OdometryIncrement Spoil(motion::OdometryIncrement moved, double now_s,
                                                double dt_s) const;

  OdometryNoise noise_;
  std::vector<std::vector<double>> moments_s_;  // of each change, since the first pose
  double delay_s_ = 0.0;
  bool begun_ = false;
  SensorTime first_{};
  motion::Pose2 last_;        // as it was given
  motion::Pose2 told_;        // before the delay
  std::deque<Told> waiting_;  // for the delay, after the last one told
};

}  // namespace trailcast::trial
