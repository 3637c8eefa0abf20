#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::trial {

// What is wrong with a robot's odometry.
enum class OdometryFault {
  kScale,   // each metre counts as so many
  kTurn,    // each radian turned counts as so many
  kDrift,   // turns by so many degrees a metre that nobody drives
  kBias,    // turns by so many radians a second, driving or standing: a gyro's bias
  kDelay,   // tells what was so many seconds ago
  kSlips,   // a wheel spins for so many seconds: a way and a turn that nobody drives
  kFrozen,  // tells of no motion for so many seconds
  kJumps,   // is somewhere else all at once, so many times
};

struct OdometryChange {
  OdometryFault fault = OdometryFault::kScale;
  double value = 0.0;  // as above

  bool operator==(const OdometryChange&) const = default;
};

using OdometryNoise = std::vector<OdometryChange>;

// "scale=1.1", "turn=0.8+drift=3", "slips" (a value left out is the kind's own); "" or "none":
// nothing is wrong. The error says which there are.
[[nodiscard]] Result<OdometryNoise> ParseOdometryNoise(const std::string& text);

// One line for each kind, for people.
[[nodiscard]] std::string OdometryNoiseHelp();

// Makes odometry wrong, pose by pose.
class OdometrySpoiler {
 public:
  // `drive_s`: about how long the robot drives; what happens at one moment does so between a
  // quarter and two thirds of that, as `seed` draws it.
  OdometrySpoiler(OdometryNoise noise, double drive_s, std::uint64_t seed);

  // What odometry tells at that time instead of the pose; times rise.
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
  motion::Pose2 told_;        // without the delay
  std::deque<Told> waiting_;  // until the delay is over, after the one told last
};

}  // namespace trailcast::trial
