#include "agent/session/src/eyes.h"

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

// How far most features moved between two frames, as a share of the picture's width.
double Flow(const std::vector<route::TrackedFeature>& before,
            const std::vector<route::TrackedFeature>& now, int width_px) {
  std::vector<double> moved;
  std::size_t i = 0;
  for (const route::TrackedFeature& feature : now) {
    while (i < before.size() && before[i].id != feature.id) ++i;
    if (i == before.size()) break;
    moved.push_back(std::hypot(feature.u_px - before[i].u_px, feature.v_px - before[i].v_px));
  }
  if (moved.size() < 4) return 1.0;
  const auto middle = moved.begin() + std::ssize(moved) / 2;
  std::nth_element(moved.begin(), middle, moved.end());
  return *middle / width_px;
}

}  // namespace

std::optional<motion::OdometryIncrement> Eyes::Driven(const Observation& observation) {
  std::optional<motion::OdometryIncrement> step;
  if (observation.odometry && last_odometry_) {
    step = motion::IncrementBetween(*last_odometry_, *observation.odometry);
  } else if (observation.odometry) {
    step = motion::OdometryIncrement{};
  }
  last_odometry_ = observation.odometry;
  return step;
}

Result<Seen> Eyes::See(const Observation& observation) {
  if (auto checked = check_.Check(observation); !checked) return tl::unexpected(checked.error());
  Seen seen;
  seen.frame = &intake_.Take(observation.image);
  seen.driven = Driven(observation);
  seen.unknown = observation.unknown;
  if (observation.stands) seen.stands = &*observation.stands;
  seen.dt_s = last_stamp_ ? Seconds(observation.stamp - *last_stamp_) : 0.0;
  last_stamp_ = observation.stamp;
  const std::vector<route::TrackedFeature> before = tracker_.Current();
  seen.features = tracker_.Track(*seen.frame, seen.driven ? seen.driven->heading_change_rad : 0.0);
  seen.flow = Flow(before, seen.features, seen.frame->width);
  return seen;
}

const image::GrayImage* Eyes::Pass(const Observation& observation) {
  return check_.Check(observation) ? &intake_.Take(observation.image) : &observation.image;
}

}  // namespace trailcast::agent
