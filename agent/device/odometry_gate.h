#pragma once

#include <optional>
#include <string>

#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// The most that a base can do between two samples of its odometry. After a longer silence it is
// taken to have stood, because it is soon told to stop.
struct GateOptions {
  double speed_mps = 3.0;
  double turn_rate_radps = 6.0;
  double longest_silence_s = 0.5;
};

// A jump further than the base can have driven.
struct OdometryJump {
  std::chrono::nanoseconds gap{};     // in which the base's motion is not known
  double distance_m = 0.0;            // by odometry
  motion::OdometryIncrement unknown;  // the most that may have been driven, in either direction

  // Returns a line for people.
  [[nodiscard]] std::string Text() const;
};

// Keeps odometry in one frame. A jump further than the base can have driven (a base that was
// restarted, a frame that was set to zero) is no motion: odometry continues from the place before
// it, and the motion meanwhile is unknown.
class OdometryGate {
 public:
  explicit OdometryGate(const GateOptions& options) : options_(options) {}

  struct Passed {
    motion::Pose2 pose;  // in the first sample's frame
    std::optional<OdometryJump> jump;
  };
  // Passes a sample on. `taken` must rise; `told` is the base's command meanwhile, if that is
  // known.
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
  motion::OdometryIncrement speed_;  // per second
};

}  // namespace trailcast::agent
