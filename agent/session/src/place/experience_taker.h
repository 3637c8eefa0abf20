#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "agent/session/src/front_end.h"
#include "services/refresh/visit.h"
#include "services/replay/camera_place.h"
#include "services/replay/follower.h"
#include "services/route/route.h"
#include "services/route/tracked_feature.h"
#include "services/vision/feature_tracker.h"

namespace trailcast::agent {

// This watches a follower that steers by odometry and features, and notes for each segment which of
// its features were found, which were missed, and what else was seen there, in the scout's terms.
// It has a tracker of its own, and changes nothing of how the follower drives.
class ExperienceTaker {
 public:
  // Takes the size of the scout's frames.
  ExperienceTaker(int scout_width_px, int scout_height_px)
      : width_px_(scout_width_px), height_px_(scout_height_px) {}

  // Takes every frame, once `follower` has made a step of it. `tracked` are the segment's features
  // at their present places. `sure` says that the robot trusts its place.
  void Look(const FrameInput& seen, const replay::Follower& follower,
            const std::vector<route::TrackedFeature>& tracked, bool sure);

  // Returns the result at the run's end. `follower` is the one of Look.
  [[nodiscard]] refresh::Visit Take(const replay::Follower& follower);

 private:
  // This is what was seen from one place.
  struct Moment {
    replay::CameraPlace place;
    std::map<int, Eigen::Vector2d> taught;  // by position in the segment
    std::map<int, Eigen::Vector2d> other;   // the tracker's own, by id
  };
  struct Candidate {
    int id = 0;
    route::Feature feature;
  };
  struct Count {
    int expected = 0;
    int found = 0;
  };

  void Open(const replay::Follower& follower, const replay::CameraPlace& place);
  void Close(const replay::Follower& follower);
  void Note(const image::GrayImage& frame, const replay::Follower& follower,
            const replay::CameraPlace& place, const std::vector<route::TrackedFeature>& tracked);
  [[nodiscard]] std::vector<int> Found() const;
  [[nodiscard]] bool PlaceWasRight(const std::vector<int>& found,
                                   const std::vector<replay::InverseDepth>& depths) const;
  [[nodiscard]] std::vector<route::Feature> Offer(const replay::Follower& follower,
                                                  const std::vector<int>& found) const;
  [[nodiscard]] bool SawItWell(const std::vector<int>& found) const;
  [[nodiscard]] bool IsNew(const route::Feature& feature, const std::vector<int>& found) const;
  [[nodiscard]] std::vector<Candidate> Candidates() const;
  [[nodiscard]] Eigen::Vector2d FirstPlace(int feature) const;
  [[nodiscard]] std::vector<route::TrackKnot> TrackOf(int id,
                                                      const replay::InverseDepth& depth) const;
  [[nodiscard]] std::vector<refresh::Sought> Judge(
      const std::vector<int>& found, const std::vector<route::Feature>& offered) const;
  [[nodiscard]] double Pixels(double at_320) const { return at_320 * width_px_ / 320.0; }

  int width_px_;
  int height_px_;
  vision::FeatureTracker tracker_;
  refresh::Visit visit_;
  std::optional<route::Segment> segment_;  // the present one
  bool sure_throughout_ = false;
  std::vector<route::DescribedFeature> others_;  // at its beginning, in the scout's pixels
  std::vector<Moment> moments_;
  std::vector<Count> counts_;  // one for each of the segment's features
};

}  // namespace trailcast::agent
