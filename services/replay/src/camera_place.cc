#include "services/replay/camera_place.h"

#include "services/base/square.h"

namespace trailcast::replay {
namespace {

constexpr int kRounds = 6;

}  // namespace

// This inverts PathEstimator's prediction. Terms that depend on the result are iterated.
Eigen::Vector2d CameraPlace::AsTaught(const Eigen::Vector2d& seen_px,
                                      double inverse_depth_per_m) const {
  const Eigen::Vector2d bent = seen_px / magnification;
  Eigen::Vector2d straight = bent;
  for (int i = 0; i < kRounds; ++i) {
    straight = bent / (1.0 + distortion * straight.squaredNorm() / Square(scout_width_px));
  }
  const double parallax_px = scout.focal_px * inverse_depth_per_m;
  Eigen::Vector2d taught = straight;
  for (int i = 0; i < kRounds; ++i) {
    const Eigen::Vector2d turned(
        straight.x() - parallax_px * left_m + taught.y() * roll_rad,
        straight.y() - taught.x() * roll_rad - scout.focal_px * pitch_rad - parallax_px * height_m);
    taught = scout.Turned(turned, -yaw_rad);
  }
  return taught;
}

}  // namespace trailcast::replay
