#include "services/replay/taught_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/route/heading.h"

namespace trailcast::replay {
namespace {

constexpr double kTrackNoise_px = 0.5;
constexpr double kNearest_m = 0.3;  // beyond the segment's end; nothing nearer is ever in view

// One stretch between two knots, the turn's part taken off.
struct Stretch {
  double middle_m = 0.0;
  double radial_flow_px2 = 0.0;  // du u + dv v
  double lever_px2_m = 0.0;      // (u^2 + v^2) ds
  double weight = 0.0;
};

Stretch Between(const route::Segment& segment, const route::TrackKnot& a, const route::TrackKnot& b,
                double focal_px) {
  const double from_m = a.s * segment.length_m;
  const double to_m = b.s * segment.length_m;
  const double turn_rad =
      route::HeadingAt(segment.heading, to_m) - route::HeadingAt(segment.heading, from_m);
  const double u = 0.5 * (a.u_px + b.u_px);
  const double v = 0.5 * (a.v_px + b.v_px);
  const double du = b.u_px - a.u_px - focal_px * turn_rad * (1.0 + u * u / (focal_px * focal_px));
  const double dv = b.v_px - a.v_px - turn_rad * u * v / focal_px;
  const double radius2 = u * u + v * v;
  // The flow's noise is kTrackNoise_px along the radius.
  return {0.5 * (from_m + to_m), du * u + dv * v, radius2 * (to_m - from_m),
          1.0 / std::max(1.0, radius2 * kTrackNoise_px * kTrackNoise_px)};
}

}  // namespace

double InverseDepth::At(double along_m) const {
  return at_start_per_m / std::max(0.05, 1.0 - at_start_per_m * along_m);
}

InverseDepth TaughtDepth(const route::Segment& segment, const route::Feature& feature,
                         double focal_px) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 1; i < feature.track.size(); ++i) {
    stretches.push_back(Between(segment, feature.track[i - 1], feature.track[i], focal_px));
  }
  const double largest_per_m = 1.0 / (segment.length_m + kNearest_m);
  InverseDepth depth;
  double information = 0.0;
  // Gauss-Newton on the depth at the segment's start: each stretch sees rho at its own middle.
  for (int iteration = 0; iteration < 4; ++iteration) {
    double gradient = 0.0;
    information = 1e-9;
    for (const Stretch& stretch : stretches) {
      const double rho = depth.At(stretch.middle_m);
      const double shrink = std::max(0.05, 1.0 - depth.at_start_per_m * stretch.middle_m);
      const double slope = stretch.lever_px2_m / (shrink * shrink);
      const double residual = stretch.radial_flow_px2 - rho * stretch.lever_px2_m;
      gradient += stretch.weight * slope * residual;
      information += stretch.weight * slope * slope;
    }
    depth.at_start_per_m =
        std::clamp(depth.at_start_per_m + gradient / information, 0.0, largest_per_m);
  }
  depth.sigma_per_m = 1.0 / std::sqrt(information);
  return depth;
}

}  // namespace trailcast::replay
