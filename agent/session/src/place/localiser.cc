#include "agent/session/src/place/localiser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/route/usual_camera.h"
#include "services/view/key_views.h"

namespace trailcast::agent {
namespace {

// So many key views around the place, and so many of the rest, are compared.
constexpr std::size_t kNearViews = 10;
constexpr std::size_t kOtherViews = 4;
constexpr std::size_t kOtherViewsWhenLost = 32;
constexpr double kLookIsDue = 1.5;  // in new looks; features are followed in the meantime
// A look is a new one once the picture has moved by this share of its width, or the robot by this
// distance.
constexpr double kNewLook_flow = 0.025;
constexpr double kNewLook_m = 0.15;
constexpr double kNewLook_rad = 0.2;
constexpr double kStill_flow = 0.0006;
constexpr double kHere = 1.0;            // around the place; in the route's units
constexpr double kOdometrySigma = 0.05;  // share of the distance
constexpr double kToldSigma = 0.2;       // the same for commanded motion
constexpr double kContradictedWithin_s = 0.3;
// So many features' agreement tells how the pictures map onto each other.
constexpr std::size_t kViewsToRecognise = 4;
constexpr int kEnoughToRecognise = 7;

}  // namespace

void Localiser::Learn(const route::Segment& segment) {
  const std::vector<route::KeyView> views = view::KeyViewsOf(segment);
  place_.Learn(segment, views, recogniser_.Learn(views));
}

void Localiser::StartAt(double along, double sigma) { place_.belief().StartAt(along, sigma); }

void Localiser::StartAnywhere() { place_.belief().StartAnywhere(); }

void Localiser::KnowMagnification(double magnification, int width_px) {
  place_.belief().KnowMagnification(
      std::log(magnification * recogniser_.scout_width_px() / width_px));
}

void Localiser::Move(const FrameMotion& moved) {
  looked_ = false;
  const auto& driven = moved.odometry ? moved.odometry : moved.told;
  if (driven && !moved.frozen) {
    new_since_look_ += std::abs(driven->distance_m) / kNewLook_m +
                       std::abs(driven->heading_change_rad) / kNewLook_rad;
  } else {
    new_since_look_ += moved.flow / kNewLook_flow;
  }
  std::vector<belief::Motion> witnesses;
  const double pace = place_.PaceAt(where().along);
  const double units_in_m = metric() ? 1.0 : pace / route::kUsualSpeed_mps;
  const auto hear = [&](const motion::OdometryIncrement& by, double sigma, bool sensed) {
    witnesses.push_back({units_in_m * by.distance_m,
                         units_in_m * std::hypot(sigma * by.distance_m, moved.unknown_m), false,
                         sensed});
  };
  by_odometry_ = moved.odometry.has_value();
  if (moved.odometry) hear(*moved.odometry, kOdometrySigma, true);
  if (moved.told) hear(*moved.told, kToldSigma, false);
  const bool moves = moved.flow > kStill_flow && moved.dt_s > 0.0;
  witnesses.push_back({moves ? moved.dt_s * pace : 0.0, 0.0, true});
  place_.belief().Move(witnesses);
  if (moved.frozen) {
    place_.belief().Contradict(0, std::min(1.0, moved.dt_s / kContradictedWithin_s));
  }
}

double Localiser::PaceAt_m(double dt_s) const {
  return dt_s * (metric() ? place_.PaceAt(where().along) : route::kUsualSpeed_mps);
}

std::optional<double> Localiser::TrustInOdometry() const {
  if (!by_odometry_) return std::nullopt;
  return belief().Trust(0);
}

void Localiser::SetTracked(const std::optional<RoutePoint>& point, int agreed) {
  tracked_.reset();
  if (point) tracked_ = {place_.AlongOf(*point), agreed};
}

bool Localiser::LookIsDue() const { return !where().held || new_since_look_ >= kLookIsDue; }

void Localiser::LookAt(const image::GrayImage& picture, int width_px) {
  belief::RouteBelief& belief = place_.belief();
  look_ = recogniser_.LookAt(
      picture, width_px,
      belief.WorthComparing(kNearViews, where().held ? kOtherViews : kOtherViewsWhenLost));
  belief.Weigh(recogniser_.Compared(look_), std::clamp(new_since_look_, kLeastNew, 1.0), tracked_);
  new_since_look_ = 0.0;
  looked_ = true;
}

int Localiser::agreed_now() const {
  int most = 0;
  if (!looked_) return most;
  for (const Look::Recognised& each : look_.views) {
    const bool here = std::abs(belief().view_at(each.view) - where().along) <= kHere;
    if (here) most = std::max(most, each.comparison.agreed());
  }
  return most;
}

int Localiser::AgreedIn(const image::GrayImage& picture) const {
  const Look look = recogniser_.Glance(picture, belief().Around(where().along, kNearViews));
  int most = 0;
  for (const Look::Recognised& each : look.views) {
    most = std::max(most, each.comparison.agreed());
  }
  return most;
}

std::optional<vision::ViewFit> Localiser::Recognise(const image::GrayImage& frame,
                                                    const RoutePoint& point) {
  const Look look = recogniser_.LookAt(frame, frame.width,
                                       belief().Around(place_.AlongOf(point), kViewsToRecognise));
  const Look::Recognised* best = look.Best();
  if (best == nullptr || best->comparison.agreed() < kEnoughToRecognise) return std::nullopt;
  return recogniser_.FitOf(look, best->comparison);
}

std::optional<double> Localiser::Magnification(int width_px) const {
  const auto known = belief().log_magnification();
  if (!known) return std::nullopt;
  return std::exp(*known) * width_px / recogniser_.scout_width_px();
}

}  // namespace trailcast::agent
