#include "agent/session/src/front_end.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::agent {
namespace {

constexpr double kUsual = 0.2;  // for each frame
// These are between two frames, by odometry, and by the picture as a share of its width.
constexpr double kStands_m = 1e-4;
constexpr double kStands_rad = 1e-4;
constexpr double kMoves_flow = 0.0015;
constexpr double kFrozen_s = 0.3;
// These are the features that tell flow, and their distance as a share of the picture's width.
constexpr std::size_t kMostForFlow = 60;
constexpr double kForFlowApart = 0.07;

// Returns how far most features moved between two frames, as a share of the picture's width.
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

// Returns the strong features of a view, which are in order of strength, in pixels of a picture of
// that width.
std::vector<route::TrackedFeature> SpreadOf(const view::ViewTable& view, int width_px) {
  std::vector<route::TrackedFeature> spread;
  const double least_px = kForFlowApart * width_px;
  for (std::size_t i = 0; i < view.size() && spread.size() < kMostForFlow; ++i) {
    const double u_px = 0.5 * width_px * view.u[i];
    const double v_px = 0.5 * width_px * view.v[i];
    const bool alone = std::none_of(spread.begin(), spread.end(), [&](const auto& other) {
      return std::abs(other.u_px - u_px) < least_px && std::abs(other.v_px - v_px) < least_px;
    });
    if (alone) spread.push_back({static_cast<int>(spread.size()), u_px, v_px});
  }
  return spread;
}

}  // namespace

void FrontEnd::Turn(const vision::IntakeOptions& intake) {
  options_ = intake;
  intake_ = vision::PictureIntake(intake);
  tracker_ = vision::FeatureTracker();
  mount_ = {};
}

std::optional<motion::OdometryIncrement> FrontEnd::Driven(const Observation& observation) {
  std::optional<motion::OdometryIncrement> step;
  if (observation.odometry && last_odometry_) {
    step = motion::IncrementBetween(*last_odometry_, *observation.odometry);
  } else if (observation.odometry) {
    step = motion::OdometryIncrement{};
  }
  last_odometry_ = observation.odometry;
  return step;
}

bool FrontEnd::IsFrozen(const FrameInput& seen) {
  const bool stands = seen.measured && std::abs(seen.measured->distance_m) < kStands_m &&
                      std::abs(seen.measured->heading_change_rad) < kStands_rad;
  const bool moves = seen.usual_flow > kMoves_flow;
  frozen_s_ = stands && moves ? frozen_s_ + seen.dt_s : 0.0;
  return frozen_s_ > kFrozen_s;
}

Result<FrameInput> FrontEnd::See(const Observation& observation) {
  if (auto checked = check_.Check(observation); !checked) return tl::unexpected(checked.error());
  FrameInput seen;
  seen.frame = &intake_.Take(observation.image);
  seen.dt_s = last_stamp_ ? Seconds(observation.stamp - *last_stamp_) : 0.0;
  last_stamp_ = observation.stamp;
  seen.measured = Driven(observation);
  is_told_ = by_commands_ && observation.told.has_value();
  told_step_.reset();
  if (observation.told) told_step_ = told_.Drive(*observation.told, seen.dt_s);
  if (is_told_) seen.told = told_step_;
  seen.driven = seen.measured ? seen.measured : seen.told;
  seen.unknown = observation.unknown;
  if (!seen.measured && seen.told) seen.unknown = DoubtOfTold(*seen.told);
  if (observation.stands) seen.stands = &*observation.stands;
  return seen;
}

void FrontEnd::Track(FrameInput& seen, FollowedFor what) {
  if (std::exchange(followed_for_, what) != what) tracker_ = vision::FeatureTracker();
  seen.followed_in = what == FollowedFor::kFlow ? &reduced_.Reduce(*seen.frame) : seen.frame;
  const image::GrayImage& picture = *seen.followed_in;
  followed_width_px_ = picture.width;
  const std::vector<route::TrackedFeature> before = tracker_.Current();
  seen.features = tracker_.Track(picture, seen.driven ? seen.driven->heading_change_rad : 0.0);
  const auto moved = teach::MovedBetween(before, seen.features);
  mount_.Add(moved, told_step_, seen.measured, seen.dt_s, std::max(picture.width, picture.height));
  const auto flow = Flow(moved, picture.width);
  if (flow) usual_flow_ += kUsual * (*flow - usual_flow_);
  seen.flow = flow.value_or(1.0);
  seen.usual_flow = usual_flow_;
  seen.frozen = IsFrozen(seen);
}

void FrontEnd::FollowSomeOf(const view::ViewTable& view) {
  tracker_.Follow(SpreadOf(view, followed_width_px_));
}

const image::GrayImage* FrontEnd::Pass(const Observation& observation) {
  return check_.Check(observation) ? &intake_.Take(observation.image) : &observation.image;
}

}  // namespace trailcast::agent
