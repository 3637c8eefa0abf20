#include "agent/session/hand_over.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/route/track.h"
#include "services/vision/view_fit.h"

namespace trailcast::agent {
namespace {

constexpr std::size_t kEnoughToLearn = 10;  // a magnification from fewer is too noisy
constexpr double kShareToLearn = 0.35;      // a smaller share of them is not trusted
constexpr std::size_t kMagnificationsKept = 15;
constexpr std::size_t kMagnificationsKnown = 10;  // weight of what an earlier run has learnt
// These are the bounds of the search at any magnification, and how far, as a logarithm, one fit may
// be from the run's magnification: a lens's distortion, or a patch seen from nearer.
constexpr double kLeastScale = 0.15;
constexpr double kMostScale = 6.5;
constexpr double kMagnificationApart = 0.3;
constexpr double kEnoughShare = 0.4;  // found nearby: no wide search is needed
constexpr std::size_t kEnoughToRecover = 10;
// This is around the place that a recognised key view gives, in scout's pixels of a picture 320 px
// wide.
constexpr double kRecognised_px = 20.0;
// At the start this allows for some degrees of heading and of mount yaw.
constexpr double kStart_px = 45.0;
constexpr double kRecover_px = 56.0;

vision::SearchRadius Around(double within_px_at_320, int scout_width_px) {
  const double u_px = within_px_at_320 * scout_width_px / 320.0;
  return {u_px, 0.5 * u_px};
}

// Prefers more of the features or, at another magnification, few but more than by chance.
bool IsBetter(const vision::FindResult& a, const vision::FindResult& b) {
  if (a.BeyondChance() != b.BeyondChance()) return a.BeyondChance();
  return a.features.size() > b.features.size();
}

double ShareInPicture(const vision::FindResult& found) {
  return static_cast<double>(found.features.size()) / std::max(1, found.in_picture);
}

// Returns how much larger than at the segment's beginning, where their patterns are from, most
// features are at its fraction `s`.
double Growth(const route::Segment& segment, double s) {
  std::vector<vision::ViewPair> pairs;
  pairs.reserve(segment.features.size());
  for (const route::Feature& feature : segment.features) {
    const route::TrackKnot there = route::TaughtPlace(feature, s);
    pairs.push_back({feature.first().u_px, feature.first().v_px, there.u_px, there.v_px});
  }
  return vision::FitView(pairs).fit.scale;
}

}  // namespace

// Finds them by patterns. A robot that assumes the scout's camera knows neither its heading nor its
// tilt, so features may be as far off along v as along u.
vision::FindResult HandOver::FindNear(const image::GrayImage& frame, const route::Segment& segment,
                                      std::span<const route::TrackedFeature> expected,
                                      double magnification, double within_px_at_320) const {
  const vision::SearchRadius radius = Around(within_px_at_320, scout_width_px_);
  return any_camera_ ? finder_.FindNear(frame, segment.features, expected, magnification, radius)
                     : finder_.FindTilted(frame, segment.features, expected, magnification,
                                          {radius.u_px, radius.u_px});
}

vision::FindResult HandOver::FindAnywhere(const image::GrayImage& frame,
                                          const route::Segment& segment, double s,
                                          const std::optional<vision::ViewFit>& recognised) const {
  if (recognised) {
    vision::FindResult found = finder_.FindNear(
        frame, segment.features, vision::TaughtPlaces(segment.features, s, *recognised),
        recognised->scale, Around(kRecognised_px, scout_width_px_));
    if (found.BeyondChance()) return found;
  }
  if (!seen_magnifications_.empty()) return {};
  return finder_.FindAtAnyMagnification(frame, segment.features, s,
                                        Around(kStart_px, scout_width_px_));
}

std::vector<route::TrackedFeature> HandOver::ToSegment(const image::GrayImage& frame,
                                                       replay::Follower& follower,
                                                       const Recognise& recognise) {
  const route::Segment& segment = follower.segment();
  last_was_wide_ = false;
  if (segment.features.empty()) return {};
  vision::FindResult found = FindNear(frame, segment, follower.Expect(), follower.magnification(),
                                      follower.expected_within_px_at_320());
  if (any_camera_ && ShareInPicture(found) < kEnoughShare) {
    vision::FindResult elsewhere = FindAnywhere(frame, segment, 0.0, recognise());
    last_was_wide_ = IsBetter(elsewhere, found);
    if (last_was_wide_) found = std::move(elsewhere);
  }
  TakeUp(found, follower);
  return std::move(found.features);
}

vision::FindResult HandOver::SeeFrom(const image::GrayImage& frame, const route::Segment& segment,
                                     double s, std::optional<double> magnification,
                                     bool grown) const {
  const double growth = grown ? Growth(segment, s) : 1.0;
  const vision::SearchRadius radius = Around(kStart_px, scout_width_px_);
  if (!magnification) {
    return finder_.FindAtAnyMagnification(frame, segment.features, s, radius, growth);
  }
  vision::FindResult seen =
      finder_.FindNear(frame, segment.features,
                       vision::TaughtPlaces(segment.features, s, {*magnification, 0.0, 0.0}),
                       *magnification * growth, radius);
  seen.magnification /= growth;
  return seen;
}

void HandOver::TakeUp(const vision::FindResult& seen, replay::Follower& follower) {
  if (any_camera_ && ShareInPicture(seen) >= kShareToLearn) Learn(seen, follower);
  share_sum_ += static_cast<double>(seen.features.size()) /
                static_cast<double>(follower.segment().features.size());
  ++count_;
}

std::vector<route::TrackedFeature> HandOver::Again(const image::GrayImage& frame,
                                                   const replay::Follower& follower) const {
  return finder_
      .FindNear(frame, follower.segment().features, follower.Expect(), follower.magnification(),
                Around(follower.expected_within_px_at_320(), scout_width_px_))
      .features;
}

void HandOver::KnowMagnification(double magnification) {
  seen_magnifications_.assign(kMagnificationsKnown, magnification);
}

// One fit builds on the magnification of the last ones. Only what the whole run has recognised
// bounds all of them.
bool HandOver::Plausible(double magnification) const {
  if (!std::isfinite(magnification) || magnification < kLeastScale || magnification > kMostScale) {
    return false;
  }
  const double run = recognised_magnification_.value_or(
      seen_magnifications_.empty() ? magnification : seen_magnifications_.front());
  return std::abs(std::log(magnification / run)) < kMagnificationApart;
}

// The magnification is a running median, so that one bad fit does no harm.
void HandOver::Learn(const vision::FindResult& found, replay::Follower& follower) {
  const bool first = seen_magnifications_.empty() && found.BeyondChance();
  if (found.features.size() < kEnoughToLearn && !first) return;
  if (!Plausible(found.magnification)) return;
  seen_magnifications_.push_back(found.magnification);
  if (seen_magnifications_.size() > kMagnificationsKept) seen_magnifications_.pop_front();
  std::vector<double> sorted(seen_magnifications_.begin(), seen_magnifications_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  follower.SetMagnification(*middle);
}

std::vector<route::TrackedFeature> HandOver::Recover(
    const image::GrayImage& frame, replay::Follower& follower, const route::Segment& segment,
    double s, const std::optional<vision::ViewFit>& recognised) {
  const double magnification = follower.magnification();
  vision::FindResult found =
      FindNear(frame, segment, vision::TaughtPlaces(segment.features, s, {magnification, 0.0, 0.0}),
               magnification, kRecover_px);
  if (any_camera_) {
    vision::FindResult elsewhere = FindAnywhere(frame, segment, s, recognised);
    if (IsBetter(elsewhere, found)) found = std::move(elsewhere);
  }
  if (found.features.size() < kEnoughToRecover && !found.BeyondChance()) return {};
  if (any_camera_) Learn(found, follower);
  return std::move(found.features);
}

}  // namespace trailcast::agent
