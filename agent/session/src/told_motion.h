#pragma once

#include "services/motion/motion.h"

namespace trailcast::agent {

// How a base moves that does what it is told after a little while: first-order lag.
class ToldMotion {
 public:
  // The base was told so for `dt_s`; how far it came meanwhile.
  [[nodiscard]] motion::OdometryIncrement Drive(const motion::VelocityCommand& told, double dt_s);

 private:
  motion::VelocityCommand moves_;
};

// How far a robot may have driven and turned besides what it was told: bases slip, and turn by
// other rates than they are asked for.
[[nodiscard]] motion::OdometryIncrement DoubtOfTold(const motion::OdometryIncrement& told);

}  // namespace trailcast::agent
