#include "agent/session/src/features/feature_search.h"

#include <algorithm>
#include <cmath>

#include "agent/session/confidence.h"

namespace trailcast::agent {
namespace {

// With a smaller share of the segment's features than this they are sought again from time to time.
constexpr double kFewShare = 0.5;
constexpr double kRefresh_s = 6.0 / 30.0;

}  // namespace

void FeatureSearch::Open(const image::GrayImage& frame) {
  frame_ = &frame;
  searches_.clear();
}

// A window that grows with the magnification keeps features longer, some of them while they slide
// off. The estimator with odometry detects those; the funnel lane does not, and does better when
// they are lost and sought again (0.58 instead of 0.81 of the turns right on a recording at 2.6
// times).
void FeatureSearch::Follow(const std::vector<route::TrackedFeature>& found,
                           const replay::Follower& follower) {
  if (front_end_.knows_motion()) front_end_.tracker().SetMagnification(follower.magnification());
  front_end_.tracker().Follow(found);
}

void FeatureSearch::Note(SearchKind kind, const route::Segment& segment, bool wide) {
  searches_.push_back(SearchOf(kind, segment, front_end_.tracker().count(), wide));
}

void FeatureSearch::Begin(replay::Follower& follower, const route::Segment& segment) {
  follower.Begin(segment);
  if (follower.turning()) {
    Forget();
  } else {
    HandOverTo(follower);
  }
}

void FeatureSearch::HandOverTo(replay::Follower& follower) {
  const route::Segment& segment = follower.segment();
  Follow(hand_over_.ToSegment(*frame_, follower,
                              [&] {
                                return place_.Recognise(*frame_, {segment.index, 0.0});
                              }),
         follower);
  Note(SearchKind::kHandOver, segment, hand_over_.last_was_wide());
  since_find_s_ = 0.0;
}

std::vector<route::TrackedFeature> FeatureSearch::Recover(replay::Follower& follower,
                                                          const route::Segment& segment,
                                                          const RoutePoint& point) {
  return hand_over_.Recover(*frame_, follower, segment, point.fraction,
                            place_.Recognise(*frame_, point));
}

void FeatureSearch::TakeUpRecovered(const std::vector<route::TrackedFeature>& found,
                                    const replay::Follower& follower,
                                    const route::Segment& segment) {
  Follow(found, follower);
  Note(SearchKind::kRecovered, segment, true);
}

void FeatureSearch::TakeUpWhereLeft(const vision::FindResult& seen, replay::Follower& follower) {
  hand_over_.TakeUp(seen, follower);
  Follow(seen.features, follower);
  Note(SearchKind::kRecovered, follower.segment(), false);
}

int FeatureSearch::InPicture(const replay::Follower& follower) const {
  const std::vector<route::TrackedFeature> places = follower.Expect();
  return static_cast<int>(
      std::count_if(places.begin(), places.end(), [&](const route::TrackedFeature& place) {
        return std::abs(place.u_px) < 0.5 * frame_->width &&
               std::abs(place.v_px) < 0.5 * frame_->height;
      }));
}

void FeatureSearch::Refresh(const replay::Follower& follower, int agreeing, double dt_s, bool now) {
  const route::Segment& segment = follower.segment();
  const bool few = agreeing < kFewShare * static_cast<double>(segment.features.size());
  since_find_s_ += dt_s;
  const bool due = since_find_s_ + kTimeSlack_s >= kRefresh_s && few;
  if (!due && !now) return;
  since_find_s_ = 0.0;
  const std::vector<route::TrackedFeature> found = hand_over_.Again(*frame_, follower);
  if (static_cast<int>(found.size()) <= agreeing) return;
  front_end_.tracker().Follow(found);
  Note(SearchKind::kLookedAgain, segment, false);
}

}  // namespace trailcast::agent
