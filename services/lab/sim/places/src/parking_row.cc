#include "services/lab/sim/places/src/parking_row.h"

#include <numbers>

namespace trailcast::sim {

void ParkingRows::Fill(const Row& row) {
  const Eigen::Vector2f ahead =
      row.along_x ? Eigen::Vector2f(1.0F, 0.0F) : Eigen::Vector2f(0.0F, 1.0F);
  const Eigen::Vector2f across(ahead.y(), ahead.x());
  const Eigen::Vector2f step = kBayWidth_m * ahead;
  paving_.BayLines(row.corner, step, kBayLength_m * across, row.bays);
  for (int i = 0; i < row.bays; ++i) {
    if (random_.Uniform() > row.share) continue;
    const auto off = [this](double most) {
      return static_cast<float>(random_.Uniform(-most, most));
    };
    const Eigen::Vector2f at = row.corner + (static_cast<float>(i) + 0.5F) * step +
                               0.5F * kBayLength_m * across + off(0.15) * ahead + off(0.2) * across;
    const bool backwards = random_.Uniform() < 0.25;
    const float heading = row.nose + (backwards ? std::numbers::pi_v<float> : 0.0F) + off(0.035);
    if (random_.Uniform() < 0.06) {
      vehicles_.Park(at.x(), at.y(), heading, VehicleShape::kVan);
    } else {
      vehicles_.ParkAny(at.x(), at.y(), heading);
    }
  }
}

}  // namespace trailcast::sim
