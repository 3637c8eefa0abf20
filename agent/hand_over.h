#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "services/image/image.h"
#include "services/replay/follower.h"
#include "services/route/tracked_feature.h"
#include "services/vision/feature_finder.h"

namespace trailcast::agent {

// The segments, from `here` on, that a robot may be in which has lost its features for so many
// frames.
[[nodiscard]] std::span<const route::Segment> WhereItMayBe(std::span<const route::Segment> segments,
                                                           SegmentIndex here, bool has_odometry,
                                                           int lost_frames);

// Finds a segment's stored features in the follower's picture, whatever its camera, and learns how
// the two cameras' magnifications compare.
class HandOver {
 public:
  // `any_camera`: look for other magnifications too; false for the paper's method, which takes the
  // cameras to be alike.
  HandOver(bool any_camera, int scout_width_px)
      : any_camera_(any_camera), scout_width_px_(scout_width_px) {}

  // The features of the segment that `follower` has just begun, in the follower's pixels. Tells the
  // follower the magnification it saw.
  [[nodiscard]] std::vector<route::TrackedFeature> ToSegment(const image::GrayImage& frame,
                                                             replay::Follower& follower);

  // A segment's features as a robot sees them that stands at its fraction `s`. `grown`: their
  // patterns as much larger as the features are there; finds them late in a segment before a near
  // wall, and elsewhere tells the place less exactly.
  [[nodiscard]] vision::FindResult SeeFrom(const image::GrayImage& frame,
                                           const route::Segment& segment, double s,
                                           double magnification, bool grown) const;
  // What was seen so counts as the hand-over to the segment that `follower` has just begun.
  void TakeUp(const vision::FindResult& seen, replay::Follower& follower);

  // The same features once more, when tracking has lost many.
  [[nodiscard]] std::vector<route::TrackedFeature> Again(const image::GrayImage& frame,
                                                         const replay::Follower& follower) const;

  struct Recovered {
    std::size_t segment = 0;  // position in `ahead`
    std::vector<route::TrackedFeature> features;
  };
  // Somewhere in the segments `ahead`, for a robot that lost its features, or never had any: tells
  // the follower the magnification it saw, too. The places are the first segment's beginning,
  // middle and end and the later ones' beginnings. A search of the whole picture for one of them
  // takes the time of several frames: a robot that can wait, knowing how far it drives meanwhile,
  // takes one place a call, by turns.
  [[nodiscard]] std::optional<Recovered> Recover(const image::GrayImage& frame,
                                                 replay::Follower& follower,
                                                 std::span<const route::Segment> ahead,
                                                 bool can_wait);

  // Whether the last ToSegment found them by a search of the whole picture.
  [[nodiscard]] bool last_was_wide() const { return last_was_wide_; }
  // Share of stored features found, mean over the hand-overs so far.
  [[nodiscard]] double found_share() const { return count_ > 0 ? share_sum_ / count_ : 0.0; }
  [[nodiscard]] int count() const { return count_; }

 private:
  [[nodiscard]] vision::FindResult FindAt(const image::GrayImage& frame,
                                          const route::Segment& segment, double s,
                                          double magnification) const;
  [[nodiscard]] vision::FindResult FindAnywhere(const image::GrayImage& frame,
                                                const route::Segment& segment, double s) const;
  void Learn(const vision::FindResult& found, replay::Follower& follower);

  vision::FeatureFinder finder_;
  bool any_camera_;
  int scout_width_px_;
  std::deque<double> seen_magnifications_;
  bool last_was_wide_ = false;
  double share_sum_ = 0.0;
  int count_ = 0;
  std::size_t turn_ = 0;  // of Recover, where it can wait
};

}  // namespace trailcast::agent
