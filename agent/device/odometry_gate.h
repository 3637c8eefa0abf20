#pragma once

#include <optional>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// What a base can do at most between two of its odometry's samples.
struct GateOptions {
  double speed_mps = 3.0;
  double turn_rate_radps = 6.0;
};

// Keeps odometry in one frame. Where it jumps further than its base can have driven (a base that
// was started anew, a frame that was set to zero) the jump is no motion: what comes after it goes
// on from the place before it. What was driven meanwhile is not known.
class OdometryGate {
 public:
  explicit OdometryGate(const GateOptions& options) : options_(options) {}

  struct Passed {
    motion::Pose2 pose;  // in the frame of the first sample
    // Over which the base's motion is not known, if it has jumped.
    std::optional<std::chrono::nanoseconds> gap;
    double jump_m = 0.0;  // as far as odometry says
  };
  // `taken` goes forward.
  [[nodiscard]] Passed Pass(SensorTime taken, const motion::Pose2& pose);

 private:
  struct Sample {
    SensorTime taken{};
    motion::Pose2 raw;
    motion::Pose2 passed;
  };
  [[nodiscard]] bool Jumps(double seconds, const motion::Pose2& moved) const;

  GateOptions options_;
  std::optional<Sample> last_;
};

}  // namespace trailcast::agent
