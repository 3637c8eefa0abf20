#include "agent/session/src/eyes.h"

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

constexpr double kUsual = 0.2;  // a frame
// Between two frames, by odometry; and by the picture, as a share of its width.
constexpr double kStands_m = 1e-4;
constexpr double kStands_rad = 1e-4;
constexpr double kMoves_flow = 0.0015;
constexpr double kFrozen_s = 0.3;

// How far most features moved between two frames, as a share of the picture's width.
std::optional<double> Flow(const std::vector<teach::MovedFeature>& features, int width_px) {
  std::vector<double> moved;
  for (const auto& [before, now] : features) {
    moved.push_back(std::hypot(now.u_px - before.u_px, now.v_px - before.v_px));
  }
  if (moved.size() < 4) return std::nullopt;
  const auto middle = moved.begin() + std::ssize(moved) / 2;
  std::nth_element(moved.begin(), middle, moved.end());
  return *middle / width_px;
}

}  // namespace

void Eyes::Turn(const vision::IntakeOptions& intake) {
  options_ = intake;
  intake_ = vision::PictureIntake(intake);
  tracker_ = vision::FeatureTracker();
  mount_ = {};
}

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

bool Eyes::IsFrozen(const Seen& seen) {
  const bool stands = seen.measured && std::abs(seen.measured->distance_m) < kStands_m &&
                      std::abs(seen.measured->heading_change_rad) < kStands_rad;
  const bool moves = seen.usual_flow > kMoves_flow;
  frozen_s_ = stands && moves ? frozen_s_ + seen.dt_s : 0.0;
  return frozen_s_ > kFrozen_s;
}

Result<Seen> Eyes::See(const Observation& observation) {
  if (auto checked = check_.Check(observation); !checked) return tl::unexpected(checked.error());
  Seen seen;
  seen.frame = &intake_.Take(observation.image);
  seen.dt_s = last_stamp_ ? Seconds(observation.stamp - *last_stamp_) : 0.0;
  last_stamp_ = observation.stamp;
  seen.measured = Driven(observation);
  is_told_ = by_commands_ && observation.told.has_value();
  std::optional<motion::OdometryIncrement> told;
  if (observation.told) told = told_.Drive(*observation.told, seen.dt_s);
  if (is_told_) seen.told = told;
  seen.driven = seen.measured ? seen.measured : seen.told;
  seen.unknown = observation.unknown;
  if (!seen.measured && seen.told) seen.unknown = DoubtOfTold(*seen.told);
  if (observation.stands) seen.stands = &*observation.stands;
  const std::vector<route::TrackedFeature> before = tracker_.Current();
  seen.features = tracker_.Track(*seen.frame, seen.driven ? seen.driven->heading_change_rad : 0.0);
  const auto moved = teach::MovedBetween(before, seen.features);
  mount_.Add(moved, told, seen.measured, seen.dt_s,
             std::max(seen.frame->width, seen.frame->height));
  const auto flow = Flow(moved, seen.frame->width);
  if (flow) usual_flow_ += kUsual * (*flow - usual_flow_);
  seen.flow = flow.value_or(1.0);
  seen.usual_flow = usual_flow_;
  seen.frozen = IsFrozen(seen);
  return seen;
}

const image::GrayImage* Eyes::Pass(const Observation& observation) {
  return check_.Check(observation) ? &intake_.Take(observation.image) : &observation.image;
}

}  // namespace trailcast::agent
