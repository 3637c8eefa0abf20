#include "services/teach/roll_by_turns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "services/base/angles.h"
#include "services/route/usual_camera.h"

namespace trailcast::teach {
namespace {

constexpr double kFlowNoise_px = 0.3;  // of a tracked feature
constexpr std::size_t kFewestMoved = 8;
// A feature that moves further between two pictures is lost, and one that is tracked there is
// another.
constexpr double kFurthest_px = 40.0;
// Beyond such a turn, a delay between the witnesses and what a robot passes weigh less. Turns
// longer ago than the time constant are forgotten, as those errors add up.
constexpr double kTurn_rad = 0.15;
constexpr double kLately_s = 3.0;
// These are shares of the flow that a usual camera has. Other cameras have lenses from fisheyes to
// telephotos.
constexpr double kLeastFlow = 0.25;
constexpr double kMostFlow = 4.0;
constexpr double kOffAxis_deg = 30.0;  // for a camera that is also mounted at an angle

}  // namespace

void RollByTurns::Add(std::span<const MovedFeature> moved, double turned_rad, double dt_s,
                      int longer_side_px) {
  const double usual_px = route::kUsualFocalShare * longer_side_px * std::abs(turned_rad);
  if (roll_deg_ || moved.size() < kFewestMoved || usual_px > kFurthest_px) return;
  const double kept = std::exp(-std::clamp(dt_s, 0.0, kLately_s) / kLately_s);
  const PictureFlow flow = FlowOf(moved, kFlowNoise_px);
  lately_ = {kept * lately_.turned_rad + turned_rad, kept * lately_.right_px + flow.u_px,
             kept * lately_.down_px + flow.v_px};
  if (std::abs(lately_.turned_rad) < kTurn_rad) return;
  const auto deg = RollIn(lately_, longer_side_px);
  if (deg && deg == last_deg_) roll_deg_ = deg;
  last_deg_ = deg;
  lately_ = {};
}

// Returns nothing if the picture did not move as any camera's would.
std::optional<double> RollByTurns::RollIn(const Moved& lately, int longer_side_px) const {
  const double usual_px = route::kUsualFocalShare * longer_side_px * lately.turned_rad;
  const double right = lately.right_px / usual_px;
  const double down = lately.down_px / usual_px;
  const double flow = std::hypot(right, down);
  if (flow < kLeastFlow || flow > kMostFlow) return std::nullopt;
  // A picture that is turned clockwise by this moves to the right.
  const double clockwise_deg = Degrees(std::atan2(-down, right));
  const double quarters = std::round(clockwise_deg / 90.0);
  if (std::abs(clockwise_deg - 90.0 * quarters) > kOffAxis_deg) return std::nullopt;
  return std::fmod(90.0 * quarters + 360.0, 360.0);
}

}  // namespace trailcast::teach
