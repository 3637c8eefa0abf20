#include "services/teach/ground_feel.h"

#include <cmath>

namespace trailcast::teach {

void GroundFeel::Add(const std::vector<motion::ImuSample>& samples, double dt_s, bool drives) {
  if (!drives || samples.empty() || !(dt_s > 0.0)) return;
  const double each_s = dt_s / static_cast<double>(samples.size());
  for (const motion::ImuSample& sample : samples) {
    if (sample.acceleration_mps2) {
      const Eigen::Vector3d& felt = *sample.acceleration_mps2;
      weight_.Add(felt.norm(), each_s);
      ahead_.Add(felt.x(), each_s);
      up_.Add(std::hypot(felt.y(), felt.z()), each_s);
    }
    if (!sample.attitude) continue;
    if (const auto climb_rad = motion::Climb(*sample.attitude)) climb_.Add(*climb_rad, each_s);
  }
}

std::optional<double> GroundFeel::vertical_mps2() const {
  const auto weight = weight_.Measure();
  if (!weight) return std::nullopt;
  return weight->deviation;
}

std::optional<double> GroundFeel::slope_rad() const {
  if (const auto climb = climb_.Measure()) return climb->mean;
  const auto ahead = ahead_.Measure();
  const auto up = up_.Measure();
  if (!ahead || !up || !(up->mean > 0.0)) return std::nullopt;
  return std::atan2(ahead->mean, up->mean);
}

void GroundFeel::EndSegment() {
  for (DrivenWindow* each : {&weight_, &climb_, &ahead_, &up_}) each->Cut();
}

}  // namespace trailcast::teach
