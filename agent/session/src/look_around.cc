#include "agent/session/look_around.h"

#include <cmath>

namespace trailcast::agent {
namespace {

constexpr double kRate_radps = 0.5;  // slow enough for sharp pictures
constexpr double kNear_rad = 1.05;   // field of view of the usual lens
constexpr double kThere_rad = 0.05;
// This multiplies the time that a turn should take. After it, a base that does not turn is not
// waited for.
constexpr double kPatience = 3.0;

}  // namespace

LookingAround::LookingAround(double furthest_rad) : furthest_rad_(furthest_rad) {
  if (furthest_rad <= 0.0) return;
  if (furthest_rad > kNear_rad) aims_rad_ = {kNear_rad, -kNear_rad};
  aims_rad_.insert(aims_rad_.end(), {furthest_rad, -furthest_rad, 0.0});
}

void LookingAround::Rest() {
  begun_ = false;
  heading_rad_ = 0.0;
  leg_ = 0;
  leg_s_ = 0.0;
}

bool LookingAround::Turn(double turned_rad, double dt_s) {
  if (leg_ == aims_rad_.size()) return false;
  if (!begun_) {
    begun_ = true;
    return true;
  }
  heading_rad_ += turned_rad;
  leg_s_ += dt_s;
  const double longest_s = kPatience * 2.0 * furthest_rad_ / kRate_radps;
  if (std::abs(Left_rad()) <= kThere_rad || leg_s_ > longest_s) {
    ++leg_;
    leg_s_ = 0.0;
  }
  return leg_ < aims_rad_.size();
}

double LookingAround::turn_rate_radps() const {
  return turns() ? std::copysign(kRate_radps, Left_rad()) : 0.0;
}

}  // namespace trailcast::agent
