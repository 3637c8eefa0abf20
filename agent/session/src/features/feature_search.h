#pragma once

#include <optional>
#include <vector>

#include "agent/session/hand_over.h"
#include "agent/session/sight.h"
#include "agent/session/src/eyes.h"
#include "agent/session/src/place/place_keeper.h"
#include "services/replay/follower.h"
#include "services/route/route.h"

namespace trailcast::agent {

// Seeks stored features in the present frame, and has the tracker follow those that it finds from
// there on. Keeps account of it for whoever watches the run.
class FeatureSearch {
 public:
  // `eyes` and `place` outlive it.
  FeatureSearch(bool any_camera, int scout_width_px, Eyes& eyes, PlaceKeeper& place)
      : hand_over_(any_camera, scout_width_px), eyes_(eyes), place_(place) {}

  // From here on it seeks in this frame.
  void Open(const image::GrayImage& frame);

  // Those of the segment that `follower` has just begun.
  void HandOverTo(replay::Follower& follower);
  // Those of any segment, as a robot at `point` sees them; nothing if they are too few to go on
  // with. They are not followed before the caller says so.
  [[nodiscard]] std::vector<route::TrackedFeature> Recover(replay::Follower& follower,
                                                           const route::Segment& segment,
                                                           const RoutePoint& point);
  void TakeUpRecovered(const std::vector<route::TrackedFeature>& found,
                       const replay::Follower& follower, const route::Segment& segment);
  // Those found where an earlier run has left the robot.
  void TakeUpWhereLeft(const vision::FindResult& seen, replay::Follower& follower);
  // Features once lost (blur, a passer-by) come back into view, and to a robot that was carried off
  // they are elsewhere: looks for them again, if that is due or `now`.
  void Refresh(const replay::Follower& follower, int agreeing, double dt_s, bool now);
  // Nothing is followed.
  void Forget() { eyes_.tracker().Follow({}); }

  [[nodiscard]] HandOver& hand_over() { return hand_over_; }
  [[nodiscard]] const HandOver& hand_over() const { return hand_over_; }
  [[nodiscard]] const image::GrayImage& frame() const { return *frame_; }
  [[nodiscard]] const std::vector<Search>& searches() const { return searches_; }  // in this frame

 private:
  void Follow(const std::vector<route::TrackedFeature>& found, const replay::Follower& follower);
  void Note(SearchKind kind, const route::Segment& segment, bool wide);

  HandOver hand_over_;
  Eyes& eyes_;
  PlaceKeeper& place_;
  const image::GrayImage* frame_ = nullptr;
  std::vector<Search> searches_;
  double since_find_s_ = 0.0;
};

}  // namespace trailcast::agent
