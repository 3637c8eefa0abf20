#pragma once

#include <optional>
#include <vector>

#include "agent/session/hand_over.h"
#include "agent/session/sight.h"
#include "agent/session/src/front_end.h"
#include "agent/session/src/place/localiser.h"
#include "services/replay/follower.h"
#include "services/route/route.h"

namespace trailcast::agent {

// This seeks stored features in the present frame, and has the tracker follow the found ones from
// there on. It keeps a record for those who watch the run.
class FeatureSearch {
 public:
  // `front_end` and `place` have to outlive it.
  FeatureSearch(bool any_camera, int scout_width_px, FrontEnd& front_end, Localiser& place)
      : hand_over_(any_camera, scout_width_px), front_end_(front_end), place_(place) {}

  // Makes it seek in this frame from now on.
  void Open(const image::GrayImage& frame);

  // Has `follower` begin the segment and finds its features, unless it turns on the spot first:
  // then they are not in view yet.
  void Begin(replay::Follower& follower, const route::Segment& segment);
  // Finds those of the segment that `follower` has just begun.
  void HandOverTo(replay::Follower& follower);
  // Returns those of any segment, as a robot at `point` sees them, or nothing if they are too few
  // to go on with. The tracker does not follow them before the caller says so.
  [[nodiscard]] std::vector<route::TrackedFeature> Recover(replay::Follower& follower,
                                                           const route::Segment& segment,
                                                           const RoutePoint& point);
  void TakeUpRecovered(const std::vector<route::TrackedFeature>& found,
                       const replay::Follower& follower, const route::Segment& segment);
  // Takes those found where an earlier run has left the robot.
  void TakeUpWhereLeft(const vision::FindResult& seen, replay::Follower& follower);
  // Looks for features again, if that is due or `now`. Lost ones (blur, a passer-by) come back into
  // view, and for a robot that was carried off they are elsewhere.
  void Refresh(const replay::Follower& follower, int agreeing, double dt_s, bool now);
  // Returns how many features of the segment should be in this frame.
  [[nodiscard]] int InPicture(const replay::Follower& follower) const;
  // Follows nothing.
  void Forget() { front_end_.tracker().Follow({}); }

  [[nodiscard]] HandOver& hand_over() { return hand_over_; }
  [[nodiscard]] const HandOver& hand_over() const { return hand_over_; }
  [[nodiscard]] const image::GrayImage& frame() const { return *frame_; }
  [[nodiscard]] const std::vector<Search>& searches() const { return searches_; }  // in this frame

 private:
  void Follow(const std::vector<route::TrackedFeature>& found, const replay::Follower& follower);
  void Note(SearchKind kind, const route::Segment& segment, bool wide);

  HandOver hand_over_;
  FrontEnd& front_end_;
  Localiser& place_;
  const image::GrayImage* frame_ = nullptr;
  std::vector<Search> searches_;
  double since_find_s_ = 0.0;
};

}  // namespace trailcast::agent
