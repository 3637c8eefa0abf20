#pragma once

#include "services/motion/motion.h"

namespace trailcast::agent {

// This models how a base moves that carries out commands after a short time: a first-order lag.
class ToldMotion {
 public:
  // Takes the command of `dt_s`, and returns how far the base came meanwhile.
  [[nodiscard]] motion::OdometryIncrement Drive(const motion::VelocityCommand& told, double dt_s);

 private:
  motion::VelocityCommand moves_;
};

// Returns how far a robot may have driven and turned beside its commands: bases slip, and turn at
// other rates than they are asked for.
[[nodiscard]] motion::OdometryIncrement DoubtOfTold(const motion::OdometryIncrement& told);

}  // namespace trailcast::agent
