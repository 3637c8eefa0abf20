#pragma once

#include <optional>
#include <string>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// What a base can do at most between two of its odometry's samples. One that is silent for longer
// is taken to stand for the rest: it is soon told to.
struct GateOptions {
  double speed_mps = 3.0;
  double turn_rate_radps = 6.0;
  double longest_silence_s = 0.5;
};

// Further than its base can have driven.
struct OdometryJump {
  std::chrono::nanoseconds gap{};     // over which the base's motion is not known
  double distance_m = 0.0;            // as far as odometry says
  motion::OdometryIncrement unknown;  // what may have been driven, one way or the other

  // A line for people.
  [[nodiscard]] std::string Text() const;
};

// Keeps odometry in one frame. Where it jumps further than its base can have driven (a base that
// was started anew, a frame that was set to zero) the jump is no motion: what comes after it goes
// on from the place before it. What was driven meanwhile is not known.
class OdometryGate {
 public:
  explicit OdometryGate(const GateOptions& options) : options_(options) {}

  struct Passed {
    motion::Pose2 pose;  // in the frame of the first sample
    std::optional<OdometryJump> jump;
  };
  // `taken` goes forward. `told`: what the base was told meanwhile, where that is known.
  [[nodiscard]] Passed Pass(SensorTime taken, const motion::Pose2& pose,
                            const motion::VelocityCommand& told = {});

 private:
  struct Sample {
    SensorTime taken{};
    motion::Pose2 raw;
    motion::Pose2 passed;
  };
  [[nodiscard]] bool Jumps(double seconds, const motion::Pose2& moved) const;
  [[nodiscard]] motion::OdometryIncrement Unknown(double gap_s,
                                                  const motion::VelocityCommand& told) const;

  GateOptions options_;
  std::optional<Sample> last_;
  motion::OdometryIncrement speed_;  // in a second
};

}  // namespace trailcast::agent
