#include "services/replay/src/track_progress.h"

#include <cmath>
#include <limits>

#include "services/route/track.h"

namespace trailcast::replay {
namespace {

constexpr int kSteps = 48;

double MeanDistance(const route::Segment& segment,
                    const std::vector<route::TrackedFeature>& features, double fraction) {
  double sum = 0.0;
  for (const route::TrackedFeature& feature : features) {
    const route::TrackKnot taught =
        route::TaughtPlace(segment.features.at(static_cast<std::size_t>(feature.id)), fraction);
    sum += std::hypot(feature.u_px - taught.u_px, feature.v_px - taught.v_px);
  }
  return sum / static_cast<double>(features.size());
}

}  // namespace

TrackProgress EstimateProgress(const route::Segment& segment,
                               const std::vector<route::TrackedFeature>& features) {
  TrackProgress best{0.0, std::numeric_limits<double>::infinity()};
  for (int step = 0; step <= kSteps; ++step) {
    const double fraction = kLargestFraction * step / kSteps;
    const double residual_px = MeanDistance(segment, features, fraction);
    if (residual_px < best.residual_px) best = {fraction, residual_px};
  }
  return best;
}

}  // namespace trailcast::replay
