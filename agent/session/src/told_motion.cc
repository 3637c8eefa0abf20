#include "agent/session/src/told_motion.h"

#include <cmath>

namespace trailcast::agent {
namespace {

constexpr double kLag_s = 0.15;  // of a small base
// These are shares of the distance and of the turn, and of either for each root metre and root
// radian.
constexpr double kShare = 0.1;
constexpr double kWay_m = 0.05;
constexpr double kTurn_rad = 0.05;

}  // namespace

motion::OdometryIncrement ToldMotion::Drive(const motion::VelocityCommand& told, double dt_s) {
  const double share = 1.0 - std::exp(-dt_s / kLag_s);
  moves_.linear_mps += share * (told.linear_mps - moves_.linear_mps);
  moves_.angular_radps += share * (told.angular_radps - moves_.angular_radps);
  return {moves_.linear_mps * dt_s, moves_.angular_radps * dt_s};
}

motion::OdometryIncrement DoubtOfTold(const motion::OdometryIncrement& told) {
  const double way_m = std::abs(told.distance_m);
  const double turn_rad = std::abs(told.heading_change_rad);
  const double moved = way_m + turn_rad;
  return {std::hypot(kShare * way_m, kWay_m * std::sqrt(way_m)),
          std::hypot(kShare * turn_rad, kTurn_rad * std::sqrt(moved))};
}

}  // namespace trailcast::agent
