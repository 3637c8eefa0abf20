#include "agent/hand_over.h"

#include <algorithm>
#include <array>
#include <utility>

#include "services/route/track.h"
#include "services/vision/view_fit.h"

namespace trailcast::agent {
namespace {

constexpr std::size_t kEnoughToLearn = 10;  // a magnification from fewer is too noisy
constexpr double kShareToLearn = 0.35;      // and from a small share of them not to be trusted
constexpr std::size_t kMagnificationsKept = 15;
constexpr double kEnoughShare = 0.4;  // found near by: the wide search is not needed
constexpr std::size_t kEnoughToRecover = 10;
constexpr double kShareToSkip = 0.5;  // of a later segment's features, to go on from there
// How many segments a lost robot looks for, the present one among them.
constexpr std::size_t kAhead = 3;
constexpr std::size_t kFurthestAhead = 10;
constexpr std::size_t kNothingToSee = 4;  // a segment with fewer features
constexpr int kFramesASegment = 5;        // hardly any is shorter
// Around what the wide search says, in scout's pixels of a picture 320 px wide.
constexpr double kAfterWide_px = 16.0;
// At the start: some degrees of heading and of mount yaw.
constexpr double kStart_px = 45.0;
constexpr double kRecover_px = 56.0;

vision::SearchRadius Around(double within_px_at_320, int scout_width_px) {
  const double u_px = within_px_at_320 * scout_width_px / 320.0;
  return {u_px, 0.5 * u_px};
}

// More of the features, or, at another magnification, few but more than chance would have.
bool IsBetter(const vision::FindResult& a, const vision::FindResult& b) {
  if (a.BeyondChance() != b.BeyondChance()) return a.BeyondChance();
  return a.features.size() > b.features.size();
}

double ShareInPicture(const vision::FindResult& found) {
  return static_cast<double>(found.features.size()) / std::max(1, found.in_picture);
}

// How much larger than at the segment's beginning, where their patterns are from, most features are
// at its fraction `s`.
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

std::span<const route::Segment> WhereItMayBe(std::span<const route::Segment> segments,
                                             SegmentIndex here, bool has_odometry,
                                             int lost_frames) {
  const auto ahead = segments.subspan(here.value());
  std::size_t reach = kAhead;
  // Nothing says when a stretch without features is over, but those that come after it.
  if (!has_odometry && ahead.front().features.size() < kNothingToSee) {
    reach += static_cast<std::size_t>(lost_frames / kFramesASegment);
  }
  return ahead.first(std::min({reach, kFurthestAhead, ahead.size()}));
}

vision::FindResult HandOver::FindAnywhere(const image::GrayImage& frame,
                                          const route::Segment& segment, double s) const {
  if (seen_magnifications_.empty()) {
    vision::FindResult found = finder_.FindAtAnyMagnification(frame, segment.features, s,
                                                              Around(kStart_px, scout_width_px_));
    if (!found.features.empty()) return found;
  }
  const vision::WideResult coarse = finder_.FindWide(frame, segment.features, s);
  if (coarse.matches == 0) return {};
  return finder_.FindNear(frame, segment.features,
                          vision::TaughtPlaces(segment.features, s, coarse.fit), coarse.fit.scale,
                          Around(kAfterWide_px, scout_width_px_));
}

std::vector<route::TrackedFeature> HandOver::ToSegment(const image::GrayImage& frame,
                                                       replay::Follower& follower) {
  const route::Segment& segment = follower.segment();
  last_was_wide_ = false;
  if (segment.features.empty()) return {};
  vision::FindResult found =
      finder_.FindNear(frame, segment.features, follower.Expect(), follower.magnification(),
                       Around(follower.expected_within_px_at_320(), scout_width_px_));
  if (any_camera_ && ShareInPicture(found) < kEnoughShare) {
    vision::FindResult elsewhere = FindAnywhere(frame, segment, 0.0);
    last_was_wide_ = IsBetter(elsewhere, found);
    if (last_was_wide_) found = std::move(elsewhere);
  }
  TakeUp(found, follower);
  return std::move(found.features);
}

vision::FindResult HandOver::SeeFrom(const image::GrayImage& frame, const route::Segment& segment,
                                     double s, double magnification, bool grown) const {
  const double growth = grown ? Growth(segment, s) : 1.0;
  vision::FindResult seen = finder_.FindNear(
      frame, segment.features, vision::TaughtPlaces(segment.features, s, {magnification, 0.0, 0.0}),
      magnification * growth, Around(kStart_px, scout_width_px_));
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

// The magnification as a running median: one bad fit does no harm.
void HandOver::Learn(const vision::FindResult& found, replay::Follower& follower) {
  const bool first = seen_magnifications_.empty() && found.BeyondChance();
  if (found.features.size() < kEnoughToLearn && !first) return;
  seen_magnifications_.push_back(found.magnification);
  if (seen_magnifications_.size() > kMagnificationsKept) seen_magnifications_.pop_front();
  std::vector<double> sorted(seen_magnifications_.begin(), seen_magnifications_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  follower.SetMagnification(*middle);
}

vision::FindResult HandOver::FindAt(const image::GrayImage& frame, const route::Segment& segment,
                                    double s, double magnification) const {
  vision::FindResult near = finder_.FindNear(
      frame, segment.features, vision::TaughtPlaces(segment.features, s, {magnification, 0.0, 0.0}),
      magnification, Around(kRecover_px, scout_width_px_));
  if (!any_camera_) return near;
  vision::FindResult anywhere = FindAnywhere(frame, segment, s);
  return IsBetter(anywhere, near) ? anywhere : near;
}

std::optional<HandOver::Recovered> HandOver::Recover(const image::GrayImage& frame,
                                                     replay::Follower& follower,
                                                     std::span<const route::Segment> ahead,
                                                     bool can_wait) {
  constexpr std::array kOfTheFirst = {0.0, 0.5, 1.0};
  const std::size_t places = kOfTheFirst.size() + ahead.size() - 1;
  const std::size_t from = can_wait ? turn_++ % places : 0;
  const std::size_t to = can_wait ? from + 1 : places;
  vision::FindResult best;
  std::size_t segment = 0;
  for (std::size_t place = from; place < to; ++place) {
    const std::size_t i = place < kOfTheFirst.size() ? 0 : place - kOfTheFirst.size() + 1;
    if (ahead[i].features.empty()) continue;
    const double s = i == 0 ? kOfTheFirst.at(place) : 0.0;
    vision::FindResult found = FindAt(frame, ahead[i], s, follower.magnification());
    if (found.features.size() <= best.features.size()) continue;
    best = std::move(found);
    segment = i;
  }
  const double share = static_cast<double>(best.features.size()) /
                       std::max(1.0, static_cast<double>(ahead[segment].features.size()));
  // What is ahead may be seen from afar: to go on from there, most of it must be.
  const bool too_far = can_wait && segment > 0 && share < kShareToSkip;
  const bool enough = best.features.size() >= kEnoughToRecover || best.BeyondChance();
  if (!enough || too_far) return std::nullopt;
  if (any_camera_ && ShareInPicture(best) >= kShareToLearn) Learn(best, follower);
  return Recovered{segment, std::move(best.features)};
}

}  // namespace trailcast::agent
