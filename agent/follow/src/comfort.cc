#include "agent/follow/comfort.h"

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

// A gentle deceleration, so that it need not brake hard before a rough section.
constexpr double kDeceleration_mps2 = 0.25;
// Rough ground further ahead needs no braking yet, at any comfortable speed.
constexpr double kAhead_m = 4.0;

}  // namespace

double ComfortableShare(const route::Terrain& terrain) {
  switch (route::RoughnessOf(terrain).value_or(route::Roughness::kSmooth)) {
    case route::Roughness::kSmooth:
      return 1.0;
    case route::Roughness::kUneven:
      return 0.7;
    case route::Roughness::kRough:
      return 0.5;
    case route::Roughness::kVeryRough:
      break;
  }
  return 0.35;
}

void Comfort::Add(const route::Segment& segment) {
  const double begin_m =
      sections_.empty() ? 0.0 : sections_.back().begin_m + sections_.back().length_m;
  const double share = ComfortableShare(segment.terrain);
  const double speed_mps = segment.has_odometry ? share * segment.speed_mps() : 0.0;
  sections_.push_back({begin_m, segment.length_m, speed_mps, share});
}

// The robot brakes gently to reach rough ground at its speed.
double Comfort::MostMps(double along_m, double speed_mps, std::size_t segment) const {
  double most_mps = speed_mps;
  const bool metric = sections_[segment].speed_mps > 0.0;
  for (std::size_t i = segment; i < sections_.size(); ++i) {
    const Section& section = sections_[i];
    const double left_m = std::max(0.0, section.begin_m - along_m);
    if (metric ? left_m > kAhead_m : i > segment + 1) break;
    if (section.share >= 1.0) continue;
    const double there_mps = metric ? section.speed_mps : section.share * speed_mps;
    most_mps = std::min(most_mps, std::sqrt(there_mps * there_mps +
                                            (metric ? 2.0 * kDeceleration_mps2 * left_m : 0.0)));
  }
  return most_mps;
}

ReplayStep Comfort::Apply(ReplayStep step) const {
  const std::size_t segment = step.segment.value();
  const double speed_mps = std::abs(step.command.linear_mps);
  if (!wanted_ || speed_mps <= 0.0 || segment >= sections_.size()) return step;
  const Section& here = sections_[segment];
  const double along_m = step.along_m.value_or(here.begin_m + step.fraction * here.length_m);
  const double share = MostMps(along_m, speed_mps, segment) / speed_mps;
  step.command.linear_mps *= share;
  step.command.angular_radps *= share;
  return step;
}

}  // namespace trailcast::agent
